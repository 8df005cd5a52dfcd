#pragma once

#include "castor/wm/filters/predicate.hpp"
#include "castor/wm/values/reflect.hpp"

#include "castor/tests/wm/values/random_values.hpp"
#include "castor/tests/wm/values/test_types.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>

/// Predicates whose meaning is also written down in C++, over things with few different values, so
/// that many predicates are true of many of them.
namespace castor::test {

struct Thing {
  std::string name;
  double number = 0;
  float narrow = 0;
  std::int32_t whole = 0;
  std::uint64_t large = 0;
  bool flag = false;
  Side side = Side::left;
  Point place;
  std::optional<double> maybe;
  std::optional<Pose> pose;
  std::array<double, 2> spot{};
};
CASTOR_REFLECT(Thing, name, number, narrow, whole, large, flag, side, place, maybe, pose, spot)

struct SpecialThing : Thing {
  std::string speciality;
};
CASTOR_REFLECT_DERIVED(SpecialThing, Thing, speciality)

Thing random_thing(Random& random);

struct RandomPredicate {
  std::string text;
  std::function<bool(const Thing&)> is_true;
};

/// Up to `depth` levels of `&&`, `||` and `!`.
RandomPredicate random_predicate(Random& random, int depth);

} // namespace castor::test
