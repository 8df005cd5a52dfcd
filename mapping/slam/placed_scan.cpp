#include "castor/mapping/slam/placed_scan.hpp"

#include <cstddef>
#include <utility>

namespace castor::mapping {

PlacedScan::PlacedScan(std::shared_ptr<const LaserScan> scan, const Pose2& robot,
                       const SurfacePoints& on_robot, const MovedOptions& options)
  : options_(options), view_(std::move(scan), robot), points_(transform(robot, on_robot)),
    seen_through_(on_robot.size()) {}

bool PlacedScan::learn_from(const View& other) {
  bool result = false;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (seen_through_[i] < options_.scans && other.passes(points_[i].position, options_.behind))
      result |= ++seen_through_[i] == options_.scans;
  return result;
}

SurfacePoints PlacedScan::standing() const {
  SurfacePoints result;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (seen_through_[i] < options_.scans)
      result.push_back(points_[i]);
  return result;
}

std::vector<bool> PlacedScan::moved() const {
  std::vector<bool> result;
  for (const auto times : seen_through_)
    result.push_back(times >= options_.scans);
  return result;
}

} // namespace castor::mapping
