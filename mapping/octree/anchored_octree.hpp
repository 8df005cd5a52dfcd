#pragma once

#include "castor/mapping/octree/occupancy_octree.hpp"
#include "castor/mapping/planar/types.hpp"

#include <map>
#include <memory>
#include <set>
#include <string>

namespace castor::mapping {

/// An octree of clouds that were seen from a robot whose poses are corrected. OctoMap cannot take a
/// cloud out again, so corrections are collected until rebuild().
class AnchoredOctree {
public:
  /// @param tolerance corrections below these do not matter: metres, and radians
  explicit AnchoredOctree(OccupancyOctreeOptions options = {}, double tolerance_metres = 0.05,
                          double tolerance_radians = 0.01);

  /// Adds a cloud, whose points are on the robot, or corrects its pose; the cloud of a known name
  /// is ignored.
  /// @returns the blocks that have changed
  std::set<BlockIndex> place(const std::string& name, std::shared_ptr<const PointCloud> cloud,
                             const Pose2& robot);

  /// Takes a cloud out at the next rebuild; an unknown one is ignored.
  void remove(const std::string& name);

  bool has(const std::string& name) const { return placed_.contains(name); }

  /// Whether a cloud has been removed, or its pose corrected by more than the tolerance.
  bool is_outdated() const { return outdated_; }

  /// Makes the octree anew of all clouds at their poses.
  /// @returns the blocks that have changed
  std::set<BlockIndex> rebuild();

  const OccupancyOctree& octree() const { return octree_; }

private:
  struct Placed {
    std::shared_ptr<const PointCloud> cloud;
    /// As it was inserted, and as it is known by now.
    Pose2 inserted;
    Pose2 robot;
  };

  OccupancyOctreeOptions options_;
  double tolerance_metres_;
  double tolerance_radians_;
  OccupancyOctree octree_;
  std::map<std::string, Placed> placed_;
  bool outdated_ = false;
};

/// The cloud in the frame of the robot's pose.
PointCloud transform(const Pose2& robot, const PointCloud& cloud);

} // namespace castor::mapping
