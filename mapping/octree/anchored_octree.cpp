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
    blocks_.insert(result.begin(), result.end());
    anchor(name, std::move(cloud), robot);
    return result;
  }
  known->second.robot = robot;
  outdated_ = outdated_ || is_off(known->second);
  return {};
}

void AnchoredOctree::restore(const std::map<BlockIndex, BlockVoxels>& blocks) {
  octree_.set_blocks(blocks);
  for (auto& [index, voxels] : blocks)
    blocks_.insert(index);
  outdated_ = true;
}

void AnchoredOctree::anchor(const std::string& name, std::shared_ptr<const PointCloud> cloud,
                            const Pose2& robot) {
  placed_.emplace(name, Placed{next_number_++, std::move(cloud), robot, robot, robot});
  if (fresh_)
    missing_.push_back(name);
}

bool AnchoredOctree::is_off(const Placed& x) const {
  return distance(x.inserted, x.robot) > tolerance_metres_ ||
         std::abs(normalised(x.robot.heading - x.inserted.heading)) > tolerance_radians_;
}

void AnchoredOctree::remove(const std::string& name) {
  if (placed_.erase(name) == 0)
    return;
  outdated_ = true;
  has_removed_ = true;
}

std::set<BlockIndex> AnchoredOctree::rebuild(std::size_t clouds) {
  if (!fresh_) {
    fresh_.emplace(options_);
    has_removed_ = false;
    std::map<std::uint64_t, std::string> names;
    for (auto& [name, x] : placed_)
      names[x.number] = name;
    missing_.clear();
    for (auto& [number, name] : names)
      missing_.push_back(name);
  }
  for (; clouds > 0 && !missing_.empty(); --clouds) {
    if (auto known = placed_.find(missing_.front()); known != placed_.end()) {
      auto& x = known->second;
      fresh_blocks_.merge(fresh_->insert(transform(x.robot, *x.cloud)));
      x.inserted_fresh = x.robot;
    }
    missing_.pop_front();
  }
  if (!missing_.empty())
    return {};
  return complete_rebuild();
}

std::set<BlockIndex> AnchoredOctree::complete_rebuild() {
  auto result = std::move(blocks_);
  result.insert(fresh_blocks_.begin(), fresh_blocks_.end());
  blocks_ = std::exchange(fresh_blocks_, {});
  octree_ = std::move(*fresh_);
  fresh_.reset();
  // What has been corrected meanwhile needs another rebuild.
  outdated_ = has_removed_;
  for (auto& [name, x] : placed_) {
    x.inserted = x.inserted_fresh;
    outdated_ = outdated_ || is_off(x);
  }
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
