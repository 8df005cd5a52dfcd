#pragma once

#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/values/known_types.hpp"

#include <set>
#include <string>
#include <string_view>

namespace castor {

/// Names in a system, or in a recording; requests may use only these.
struct KnownNames {
  TypeCatalogue types;
  std::set<std::string> subarchitectures;
  /// Components and other sources of changes; if empty, all names are accepted.
  std::set<std::string> sources;
};

/// "; did you mean 'vision'?", or "; there are: ..." with the known names.
std::string nearest_known(std::string_view name, const std::set<std::string>& known);

/// The type of that name; null if it is a base of known types only. Throws std::runtime_error with
/// the nearest known name.
TypeDescriptorPtr find_type(const std::string& name, const TypeCatalogue& types);

/// Whether a type has that name, or derives from one that has it.
bool is_known_type(const std::string& name, const TypeCatalogue& types);

/// Throws std::runtime_error, with the nearest known name, if the filter names a type, a field, a
/// subarchitecture or a component that does not exist: it would never match.
void check_names(const ChangeFilter& filter, const KnownNames& known);

} // namespace castor
