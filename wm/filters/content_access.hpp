#pragma once

#include "castor/wm/filters/predicate.hpp"
#include "castor/wm/values/field_access.hpp"

#include <string>
#include <vector>

namespace castor {

struct Interval {
  double low = 0;
  double high = 0;
};

/// The part of a predicate that is indexed: a necessary condition on one field, which can be looked
/// up by the field's value.
struct ContentAccess {
  enum class Kind {
    /// No part can be indexed.
    none,
    /// The field equals `literal`.
    equal,
    /// The field, a number or a point, lies in `region`: an interval for each coordinate.
    region,
    /// The field is greater (or less) than `threshold`, or equal to it if `inclusive`.
    above,
    below,
  };

  Kind kind = Kind::none;
  std::string path;
  FieldValue literal;
  std::vector<Interval> region;
  /// long double represents every number of a field exactly on x86-64.
  long double threshold = 0;
  bool inclusive = false;
};

/// The most selective part: an equality, else the neighbourhood of a point, else a range with two
/// bounds, else one with one bound; the first one of a kind.
ContentAccess content_access(const Predicate& x);

} // namespace castor
