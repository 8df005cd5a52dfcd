#include "castor/mapping/grid/keyframe_grid.hpp"

#include <cmath>
#include <utility>

namespace castor::mapping {

KeyframeGrid::KeyframeGrid(OccupancyGridOptions options) : KeyframeGrid(options, Tolerance{}) {
  // nop
}

std::set<TileIndex> KeyframeGrid::place(const std::string& keyframe,
                                        std::shared_ptr<const LaserScan> scan, const Pose2& robot) {
  auto known = placed_.find(keyframe);
  if (known == placed_.end()) {
    auto result = grid_.insert(*scan, robot);
    placed_.emplace(keyframe, Placed{std::move(scan), robot});
    return result;
  }
  auto& x = known->second;
  if (is_within_tolerance(x.robot, robot))
    return {};
  auto result = grid_.remove(*x.scan, x.robot);
  x.robot = robot;
  result.merge(grid_.insert(*x.scan, robot));
  return result;
}

std::set<TileIndex> KeyframeGrid::remove(const std::string& keyframe) {
  auto known = placed_.find(keyframe);
  if (known == placed_.end())
    return {};
  auto result = grid_.remove(*known->second.scan, known->second.robot);
  placed_.erase(known);
  return result;
}

bool KeyframeGrid::is_within_tolerance(const Pose2& before, const Pose2& after) const {
  return distance(before, after) <= tolerance_.metres &&
         std::abs(normalised(after.heading - before.heading)) <= tolerance_.radians;
}

} // namespace castor::mapping
