#pragma once

#include <castor/wm/values/reflect.hpp>

#include <string>

/// A cup that somebody sees.
struct Cup {
  /// From the camera, metres.
  double distance = 0;
  /// What it is; empty until somebody knows.
  std::string label;
};
CASTOR_REFLECT(Cup, distance, label)
