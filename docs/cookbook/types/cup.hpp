#pragma once

#include <castor/wm/values/reflect.hpp>

#include <string>

struct Cup {
  /// From the camera, metres.
  double distance = 0;
  std::string label;
};
CASTOR_REFLECT(Cup, distance, label)
