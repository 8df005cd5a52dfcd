#include "castor/mapping/localisation/map_alignment.hpp"

#include "castor/mapping/planar/beams.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace castor::mapping {

std::vector<Point2> ends_of_beams(const LaserScan& scan, std::size_t beams) {
  auto each = std::max<std::size_t>(1, scan.ranges.size() / std::max<std::size_t>(1, beams));
  std::vector<Point2> result;
  for (std::size_t i = 0; i < scan.ranges.size(); i += each) {
    auto range = static_cast<double>(scan.ranges[i]);
    if (!(range > 0) || range >= scan.max_range)
      continue;
    result.push_back(transform(scan.mount, end_of_beam(scan, i)));
  }
  return result;
}

Pose2 aligned(const DistanceField& map, const std::vector<Point2>& points, const Pose2& guess,
              const MapAlignmentOptions& options) {
  auto pose = guess;
  const Eigen::Vector3d known(1 / (options.prior * options.prior),
                              1 / (options.prior * options.prior),
                              1 / (options.prior_heading * options.prior_heading));
  auto deviation = options.first_deviation;
  for (int i = 0; i < options.iterations; ++i) {
    deviation = std::max(options.deviation, options.narrowing * deviation);
    auto squared_deviation = deviation * deviation;
    Eigen::Matrix3d information = known.asDiagonal();
    Eigen::Vector3d gradient = known.cwiseProduct(Eigen::Vector3d(
      pose.x - guess.x, pose.y - guess.y, normalised(pose.heading - guess.heading)));
    auto c = std::cos(pose.heading);
    auto s = std::sin(pose.heading);
    for (const auto& point : points) {
      Point2 arm{c * point.x - s * point.y, s * point.x + c * point.y};
      auto there = map.slope(pose.x + arm.x, pose.y + arm.y);
      if (!there || there->distance > options.furthest)
        continue;
      auto root = 1 / (1 + there->distance * there->distance / squared_deviation);
      auto weight = root * root / squared_deviation;
      Eigen::Vector3d jacobian(there->dx, there->dy, there->dy * arm.x - there->dx * arm.y);
      information += weight * jacobian * jacobian.transpose();
      gradient += weight * there->distance * jacobian;
    }
    Eigen::Vector3d step = information.ldlt().solve(-gradient);
    if (!step.allFinite())
      return guess;
    pose.x += step.x();
    pose.y += step.y();
    pose.heading = normalised(pose.heading + step.z());
    if (deviation == options.deviation && std::hypot(step.x(), step.y()) < 1e-3 &&
        std::abs(step.z()) < 1e-3)
      break;
  }
  return pose;
}

} // namespace castor::mapping
