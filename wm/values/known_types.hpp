#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstddef>
#include <map>
#include <string>

namespace castor {

/// Descriptors by type name.
using TypeCatalogue = std::map<std::string, TypeDescriptorPtr>;

/// Maximum number of foreign types that are remembered.
inline constexpr std::size_t most_foreign_types = 4096;

/// Registers a type with a C++ type in this process.
void make_own_type_known(const TypeDescriptorPtr& type);

/// Registers a type that was received with an entry, from another process or a journal.
void make_foreign_type_known(const TypeDescriptorPtr& type);

/// The entry types that this process knows: those used in the code of its loaded libraries (even if
/// it has not run yet), and foreign ones. An own type takes precedence over a foreign one of the
/// same name.
TypeCatalogue known_types();

namespace detail {

/// Registers a type for `known_types` by the function that makes its descriptor.
bool announce_type(const TypeDescriptorPtr& (*descriptor)());

} // namespace detail

} // namespace castor
