#pragma once

#include "castor/tests/wm/values/random_values.hpp"

#include <cstdint>

#include <rapidcheck.h>

namespace castor::test {

/// How many random values are tried in one run of a property.
inline constexpr int rounds = 50;

/// Random numbers for one run of a property, which shows their seed if it fails.
inline Random seeded() {
  return Random{*rc::gen::arbitrary<std::uint64_t>()};
}

} // namespace castor::test
