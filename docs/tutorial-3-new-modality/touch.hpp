#pragma once

#include <castor/wm/values/reflect.hpp>

#include <string>

/// Something was touched here, metres on the table, and it felt like this.
struct Touch {
  double x = 0;
  double y = 0;
  double z = 0;
  std::string material;
};
CASTOR_REFLECT(Touch, x, y, z, material)
