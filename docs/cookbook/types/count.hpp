#pragma once

#include <castor/wm/values/reflect.hpp>

struct Count {
  int value = 0;
};
CASTOR_REFLECT(Count, value)
