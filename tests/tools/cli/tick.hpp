#pragma once

#include "castor/wm/values/reflect.hpp"

namespace castor::test {

struct Tick {
  int number = 0;
};
CASTOR_REFLECT(Tick, number)

} // namespace castor::test
