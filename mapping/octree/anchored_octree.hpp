#pragma once

#include "castor/mapping/octree/occupancy_octree.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace castor::mapping {

/// An octree of clouds that were seen from a robot whose poses are corrected. OctoMap cannot take a
/// cloud out again, so corrections are collected until the octree is made anew, some clouds at a
/// time, as that takes long.
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

  /// Goes on from the blocks of one before, which is outdated: they answer until a rebuild is
  /// complete. To be called before clouds are added.
  void restore(const std::map<BlockIndex, BlockVoxels>& blocks);

  /// Adds a cloud that is in the restored blocks already: a rebuild inserts it.
  void anchor(const std::string& name, std::shared_ptr<const PointCloud> cloud, const Pose2& robot);

  /// Takes a cloud out at the next rebuild; an unknown one is ignored.
  void remove(const std::string& name);

  bool has(const std::string& name) const { return placed_.contains(name); }

  /// Whether a cloud has been removed, or its pose corrected by more than the tolerance.
  bool is_outdated() const { return outdated_; }

  /// Whether a rebuild has begun and is not complete.
  bool is_rebuilding() const { return fresh_.has_value(); }

  /// Begins to make the octree anew, or goes on, with up to so many clouds at their poses, in the
  /// order in which they came: what was seen last counts most. The old octree answers until the new
  /// one is complete.
  /// @returns the blocks that may have changed, once it is complete
  std::set<BlockIndex> rebuild(std::size_t clouds = std::numeric_limits<std::size_t>::max());

  const OccupancyOctree& octree() const { return octree_; }

private:
  struct Placed {
    /// Counts the clouds as they came.
    std::uint64_t number = 0;
    std::shared_ptr<const PointCloud> cloud;
    /// As it was inserted in the octree and in the fresh one, and as it is known by now.
    Pose2 inserted;
    Pose2 inserted_fresh;
    Pose2 robot;
  };

  std::set<BlockIndex> complete_rebuild();
  bool is_off(const Placed& x) const;

  OccupancyOctreeOptions options_;
  double tolerance_metres_;
  double tolerance_radians_;
  OccupancyOctree octree_;
  /// Those that have a known voxel.
  std::set<BlockIndex> blocks_;
  std::map<std::string, Placed> placed_;
  std::uint64_t next_number_ = 0;
  bool outdated_ = false;
  /// During a rebuild: the new octree, its blocks, clouds that are missing in it, and whether one
  /// has been removed that may be in it.
  std::optional<OccupancyOctree> fresh_;
  std::set<BlockIndex> fresh_blocks_;
  std::deque<std::string> missing_;
  bool has_removed_ = false;
};

/// The cloud in the frame of the robot's pose.
PointCloud transform(const Pose2& robot, const PointCloud& cloud);

} // namespace castor::mapping
