#include "castor/mapping/slam/pose_news.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <cmath>

namespace castor::mapping {

namespace {

bool is_within(const Pose2& step, double way, double turn) {
  return std::hypot(step.x, step.y) < way && std::abs(step.heading) < turn;
}

} // namespace

bool PoseNews::is_news(const RobotPose& x, const Pose2& odometry) const {
  if (!last_ || x.state != last_->pose.state || x.reason != last_->pose.reason)
    return true;
  if (x.time - last_->pose.time < options_.period)
    return false;
  const auto by_wheels = between(last_->odometry, odometry);
  if (!is_within(by_wheels, options_.rest, options_.rest_heading))
    return true;
  const auto expected = compose(last_->pose.pose, by_wheels);
  return !is_within(between(expected, x.pose), options_.tolerance, options_.tolerance_heading);
}

} // namespace castor::mapping
