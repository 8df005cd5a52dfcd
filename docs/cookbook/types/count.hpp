#pragma once

#include <castor/wm/reflect.hpp>

struct Count {
  int value = 0;
};
CASTOR_REFLECT(Count, value)
