#pragma once

#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/values/known_types.hpp"

#include <set>
#include <string>
#include <string_view>

namespace castor {

/// What there is in a system, or in a recording: what somebody asks for has to be among it.
struct KnownNames {
  TypeCatalogue types;
  std::set<std::string> subarchitectures;
  /// Components, and others who make changes; if empty, anybody may.
  std::set<std::string> sources;
};

/// "; did you mean 'vision'?", or "; there are: ..." with what there is.
std::string nearest_known(std::string_view name, const std::set<std::string>& known);

/// The type of that name; null if it is a base of known types only. Throws std::runtime_error with
/// the nearest known name.
TypeDescriptorPtr find_type(const std::string& name, const TypeCatalogue& types);

/// Whether a type has that name, or derives from one that has it.
bool is_known_type(const std::string& name, const TypeCatalogue& types);

/// Throws std::runtime_error, with the nearest known name, if the filter names a type, a field, a
/// subarchitecture or a component that there is not: it would want nothing, for ever.
void check_names(const ChangeFilter& filter, const KnownNames& known);

} // namespace castor
