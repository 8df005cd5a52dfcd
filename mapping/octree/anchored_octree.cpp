#include "castor/mapping/octree/anchored_octree.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <cmath>
#include <utility>

namespace castor::mapping {

AnchoredOctree::AnchoredOctree(OccupancyOctreeOptions options, double tolerance_metres,
                               double tolerance_radians)
  : options_(options), tolerance_metres_(tolerance_metres), tolerance_radians_(tolerance_radians),
    octree_(options) {
  // nop
}

std::set<BlockIndex> AnchoredOctree::place(const std::string& name,
                                           std::shared_ptr<const PointCloud> cloud,
                                           const Pose2& robot) {
  auto known = placed_.find(name);
  if (known == placed_.end()) {
    auto result = octree_.insert(transform(robot, *cloud));
    placed_.emplace(name, Placed{std::move(cloud), robot, robot});
    return result;
  }
  auto& x = known->second;
  x.robot = robot;
  outdated_ = outdated_ || distance(x.inserted, robot) > tolerance_metres_ ||
              std::abs(normalised(robot.heading - x.inserted.heading)) > tolerance_radians_;
  return {};
}

void AnchoredOctree::remove(const std::string& name) {
  outdated_ = placed_.erase(name) > 0 || outdated_;
}

std::set<BlockIndex> AnchoredOctree::rebuild() {
  OccupancyOctree fresh{options_};
  for (auto& [name, x] : placed_) {
    fresh.insert(transform(x.robot, *x.cloud));
    x.inserted = x.robot;
  }
  outdated_ = false;
  std::set<BlockIndex> result;
  auto candidates = octree_.blocks();
  candidates.merge(fresh.blocks());
  for (auto& x : candidates)
    if (octree_.block(x) != fresh.block(x))
      result.insert(x);
  octree_ = std::move(fresh);
  return result;
}

PointCloud transform(const Pose2& robot, const PointCloud& cloud) {
  auto moved = [c = std::cos(robot.heading), s = std::sin(robot.heading),
                &robot](const geometry::Point3& x) {
    return geometry::Point3{robot.x + c * x.x - s * x.y, robot.y + s * x.x + c * x.y, x.z};
  };
  PointCloud result{moved(cloud.sensor), {}};
  result.points.reserve(cloud.points.size());
  for (auto& x : cloud.points)
    result.points.push_back(moved(x));
  return result;
}

} // namespace castor::mapping
