#pragma once

#include "castor/wm/filters/predicate.hpp"

#include <cstddef>
#include <string>

namespace castor {

/// Which entries a reader wants.
struct TypeQuery {
  std::string subarchitecture;
  /// Empty for every type.
  std::string type;
  /// At most so many, the most recently written ones; 0 for all.
  std::size_t count = 0;
  /// Whether entries of types that derive from `type` count too.
  bool with_derived = false;
  /// What must be true of their content; entries that lack the fields do not count.
  Predicate predicate = {};
};

} // namespace castor
