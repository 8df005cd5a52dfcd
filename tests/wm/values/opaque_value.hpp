#pragma once

#include "castor/wm/values/value.hpp"

namespace castor::test {

/// The value as a process has it that lacks its C++ type.
inline Value opaque(const Value& x) {
  return decode_self_described(encode_self_described(x));
}

} // namespace castor::test
