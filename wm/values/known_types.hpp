#pragma once

#include "castor/wm/values/type_descriptor.hpp"

#include <cstddef>
#include <map>
#include <string>

namespace castor {

/// Descriptors by the names of the types.
using TypeCatalogue = std::map<std::string, TypeDescriptorPtr>;

/// At most so many types that came from elsewhere are remembered.
inline constexpr std::size_t most_foreign_types = 4096;

/// Makes a type known that this process has a C++ type for.
void make_own_type_known(const TypeDescriptorPtr& type);

/// Makes a type known that came with an entry, from another process or from a journal.
void make_foreign_type_known(const TypeDescriptorPtr& type);

/// The entry types that this process knows: those that the code of its loaded libraries writes,
/// reads, filters or serves, whether it has done so yet or not, and those that came from elsewhere.
/// Of two types of one name, an own one counts.
TypeCatalogue known_types();

namespace detail {

/// Makes a type known to `known_types` by what makes its descriptor.
bool announce_type(const TypeDescriptorPtr& (*descriptor)());

} // namespace detail

} // namespace castor
