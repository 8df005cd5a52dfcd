#pragma once

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_bridge.hpp"

namespace castor::geometry {

/// A Ray in the form that Eigen calculates with; its parameter is the distance from the origin,
/// metres. For source files and private headers only.
using EigenRay = Eigen::ParametrizedLine<double, 3>;

inline EigenRay to_eigen(const Ray& ray) {
  return {to_eigen(ray.origin), to_eigen(ray.direction)};
}

} // namespace castor::geometry
