#pragma once

#include "castor/mapping/geometry/eigen_bridge.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/mapping/geometry/types.hpp"

#include <rapidcheck.h>

#include <cmath>
#include <string>
#include <utility>

namespace castor::geometry::test {

/// A number in [low, high], by steps of a ten thousandth of the range.
inline double in_range(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 10'001) / 10'000.0;
}

inline Rotation any_rotation() {
  Eigen::Quaterniond q(in_range(-1, 1), in_range(-1, 1), in_range(-1, 1), in_range(-1, 1));
  RC_PRE(q.norm() > 0.1);
  return to_rotation(q.normalized());
}

inline Point3 any_point() {
  return {in_range(-5, 5), in_range(-5, 5), in_range(-5, 5)};
}

inline Pose any_pose(std::string frame) {
  return {any_point(), any_rotation(), std::move(frame)};
}

inline bool near(const Point3& a, const Point3& b, double tolerance = 1e-9) {
  return distance(a, b) < tolerance;
}

/// q and -q are one rotation.
inline bool near(const Rotation& a, const Rotation& b, double tolerance = 1e-9) {
  return std::abs(std::abs(to_eigen(a).dot(to_eigen(b))) - 1) < tolerance;
}

inline bool near(const Pose& a, const Pose& b, double tolerance = 1e-9) {
  return a.frame == b.frame && near(a.position, b.position, tolerance) &&
         near(a.rotation, b.rotation, tolerance);
}

} // namespace castor::geometry::test
