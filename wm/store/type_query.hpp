#pragma once

#include "castor/wm/filters/predicate.hpp"

#include <cstddef>
#include <string>

namespace castor {

/// A query for entries by type and content.
struct TypeQuery {
  std::string subarchitecture;
  /// Empty for every type.
  std::string type;
  /// Maximum number of entries, the most recently written ones; 0 for all.
  std::size_t count = 0;
  /// Includes entries of types that derive from `type`.
  bool with_derived = false;
  /// Condition on their content; entries without the fields do not match.
  Predicate predicate = {};
};

} // namespace castor
