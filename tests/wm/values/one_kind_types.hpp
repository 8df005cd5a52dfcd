#pragma once

#include "castor/tests/wm/values/test_types.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Entry types with fields of one kind.
namespace castor::test {

struct Text {
  std::string s;
};
CASTOR_REFLECT(Text, s)

struct Integers {
  std::vector<std::uint32_t> n;
};
CASTOR_REFLECT(Integers, n)

struct Blob {
  Bytes data;
};
CASTOR_REFLECT(Blob, data)

struct Chosen {
  Side side = Side::left;
  Trend trend = Trend::flat;
  Huge huge = Huge::one;
};
CASTOR_REFLECT(Chosen, side, trend, huge)

} // namespace castor::test
