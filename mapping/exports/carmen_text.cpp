#include "castor/mapping/exports/carmen_text.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

namespace castor::mapping {

namespace {

constexpr const char* host = "castor";

/// Whether readers of FLASER lines see the same angles: 180 degrees from the right, whether or not
/// the last beam is the one at the end.
bool is_front_laser(const LaserScan& scan) {
  constexpr double tolerance = 1e-3;
  using std::numbers::pi;
  auto width = static_cast<double>(scan.ranges.size()) * scan.angle_step;
  return std::abs(scan.first_angle + pi / 2) < tolerance &&
         (std::abs(width - pi) < tolerance || std::abs(width - scan.angle_step - pi) < tolerance);
}

std::string ranges_of(const LaserScan& scan) {
  std::string result;
  for (auto x : scan.ranges)
    fmt::format_to(std::back_inserter(result), "{:.3f} ",
                   std::isfinite(x) && x > 0 ? static_cast<double>(x) : scan.max_range);
  return result;
}

std::string pose_text(const Pose2& x) {
  return fmt::format("{:.6f} {:.6f} {:.6f}", x.x, x.y, x.heading);
}

} // namespace

std::string carmen_text(const MapContents& map) {
  std::string result =
    "# Scans at their corrected poses, by Castor.\n"
    "# FLASER count ranges... x y theta odom_x odom_y odom_theta time host time\n"
    "# ROBOTLASER1 type start_angle field_of_view angular_resolution max_range "
    "accuracy remission_mode count ranges... 0 laser_pose robot_pose tv rv "
    "forward_safety_dist side_safety_dist turn_axis time host time\n";
  auto out = std::back_inserter(result);
  for (auto& x : map.keyframes) {
    auto& scan = x.scan;
    auto laser = pose_text(compose(x.pose, scan.mount));
    auto seconds = static_cast<double>(x.time) / 1e6;
    auto ranges = ranges_of(scan);
    if (is_front_laser(scan)) {
      fmt::format_to(out, "FLASER {} {}{} {} {:.6f} {} {:.6f}\n", scan.ranges.size(), ranges, laser,
                     pose_text(x.odometry), seconds, host, seconds);
    } else {
      auto field =
        scan.ranges.empty() ? 0 : static_cast<double>(scan.ranges.size() - 1) * scan.angle_step;
      fmt::format_to(out,
                     "ROBOTLASER1 0 {:.6f} {:.6f} {:.6f} {:.3f} 0.01 0 {} {}0 {} {} 0 0 0 0 0 "
                     "{:.6f} {} {:.6f}\n",
                     scan.first_angle, field, scan.angle_step, scan.max_range, scan.ranges.size(),
                     ranges, laser, pose_text(x.pose), seconds, host, seconds);
    }
  }
  return result;
}

} // namespace castor::mapping
