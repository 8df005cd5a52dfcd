#pragma once

#include "castor/mapping/grid/cells.hpp"
#include "castor/mapping/octree/point_cloud.hpp"
#include "castor/mapping/octree/types.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

namespace octomap {
class OcTree;
}

namespace castor::mapping {

/// A block of an octree, counted as in OctreeBlock.
struct BlockIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;

  friend auto operator<=>(const BlockIndex&, const BlockIndex&) = default;
};

/// Voxels on a side of a block.
inline constexpr int block_side = 16;

/// Voxels of a block as log-odds, as in TileCells: x first, then y, then z.
using BlockVoxels = TileCells;
static_assert(block_side * block_side * block_side == tile_side * tile_side);

struct OccupancyOctreeOptions {
  /// Side of a voxel, metres.
  double voxel_size = 0.05;
  /// Points farther away are evidence for free space up to this distance only; metres.
  double max_range = 8;
};

/// Free and occupied space in three dimensions: OctoMap (A. Hornung et al., "OctoMap: an efficient
/// probabilistic 3D mapping framework based on octrees", 2013) with its default sensor model.
class OccupancyOctree {
public:
  /// @throws std::invalid_argument if an option is not positive
  explicit OccupancyOctree(OccupancyOctreeOptions options = {});
  OccupancyOctree(OccupancyOctree&&) noexcept;
  OccupancyOctree& operator=(OccupancyOctree&&) noexcept;
  ~OccupancyOctree();

  /// Adds the evidence of a cloud. Points in one voxel count as one, which takes one ray instead of
  /// many. Points that are not finite, or outside of the octree (32768 voxels from the origin), are
  /// ignored.
  /// @returns the blocks that have changed: those with a voxel that was not at its limit yet
  std::set<BlockIndex> insert(const PointCloud& cloud);

  // -- queries

  PointOccupancy at(const geometry::Point3& point) const;
  /// @throws std::invalid_argument for a direction of length 0, or numbers that are not finite
  RayEnd cast(const AskRay& ray) const;
  /// @throws std::invalid_argument for a box of more than 10 million voxels, or of a negative size,
  /// or with numbers that are not finite, or outside of the octree
  BoxOccupancy look_into(const geometry::AlignedBox& box) const;

  std::size_t leaves() const;
  double voxel_size() const { return options_.voxel_size; }

  // -- in blocks

  BlockVoxels block(const BlockIndex& block) const;
  /// Sets the voxels of blocks to what another octree has there. That takes a copy of the octree if
  /// a known voxel becomes unknown, so set all blocks at once.
  void set_blocks(const std::map<BlockIndex, BlockVoxels>& blocks);
  /// All blocks with a known voxel.
  std::set<BlockIndex> blocks() const;

  // -- files

  /// Writes OctoMap's file: `.ot` keeps the log-odds, `.bt` only which voxels are free and
  /// occupied.
  /// @throws std::runtime_error if it cannot be written, or has another ending
  void write(const std::filesystem::path& path) const;

private:
  OccupancyOctreeOptions options_;
  std::unique_ptr<octomap::OcTree> tree_;
};

} // namespace castor::mapping
