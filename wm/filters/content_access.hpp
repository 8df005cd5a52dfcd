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

/// The part of a predicate by which it is found: something that must be true of one field for the
/// whole to be true, and can be looked up by the field's value.
struct ContentAccess {
  enum class Kind {
    /// Nothing can be looked up.
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
  /// Holds every number of a field exactly on x86-64.
  long double threshold = 0;
  bool inclusive = false;
};

/// The most selective part, the earlier of two alike: an equality, else the neighbourhood of a
/// point, else a range with two ends, else one with one end.
ContentAccess content_access(const Predicate& x);

} // namespace castor
