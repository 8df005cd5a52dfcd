#pragma once

#include <Eigen/Geometry>

#include "castor/mapping/geometry/types.hpp"

/// Points and rotations in the form that Eigen calculates with. For source files and private
/// headers only: no public header includes Eigen.
namespace castor::geometry {

inline Eigen::Vector3d to_eigen(const Point3& point) {
  return {point.x, point.y, point.z};
}

inline Eigen::Quaterniond to_eigen(const Rotation& rotation) {
  return {rotation.w, rotation.x, rotation.y, rotation.z};
}

inline Point3 to_point(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

inline Rotation to_rotation(const Eigen::Quaterniond& quaternion) {
  return {quaternion.w(), quaternion.x(), quaternion.y(), quaternion.z()};
}

} // namespace castor::geometry
