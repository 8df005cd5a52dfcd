#include "castor/mapping/movement/pose_path.hpp"

#include <cmath>

namespace castor::mapping {

Pose2 pose_on(const Pose2& begin, const Twist2& motion, double share) {
  return moved(begin, motion, share);
}

std::vector<Pose2> begins_of(const PosePath& path) {
  std::vector<Pose2> result{path.start};
  for (const auto& x : path.motions)
    result.push_back(pose_on(result.back(), x, 1));
  return result;
}

double length(const PosePath& path) {
  double result = 0;
  for (const auto& x : path.motions)
    result += std::abs(x.forward);
  return result;
}

int gear_changes(const PosePath& path) {
  int result = 0;
  double before = 0;
  for (const auto& x : path.motions) {
    if (x.forward == 0)
      continue;
    if (before * x.forward < 0)
      ++result;
    before = x.forward;
  }
  return result;
}

} // namespace castor::mapping
