#pragma once

#include "castor/mapping/geometry/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <vector>

/// The octree of occupied and free space on working memory: cubes of voxels, each an entry of its
/// own, and the queries that are answered by calls.
namespace castor::mapping {

/// Entry: a cube of 16 x 16 x 16 voxels. One entry for each cube that a scan has changed, which is
/// overwritten. Whoever reads all of them has the map; whoever is told of changes keeps it.
struct OctreeBlock {
  /// Block (0, 0, 0) has its lowest corner at the origin of the frame; all may be negative.
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  /// Number of modifications of the voxels, from 1.
  std::uint64_t version = 0;
  /// Side of a voxel, metres.
  double voxel_size = 0;
  /// The voxels: x first, then y, then z, encoded as those of a GridTile.
  std::vector<std::uint8_t> bytes;

  friend bool operator==(const OctreeBlock&, const OctreeBlock&) = default;
};

/// Push: points that a depth camera or a rotating laser of the robot saw at once. The frame is the
/// robot's: x forward, y to the left, z up from the floor.
struct SensedCloud {
  /// When it was measured, microseconds since the system began.
  std::int64_t time = 0;
  geometry::Point3 sensor;
  /// x, y, z of one point after the other, metres.
  std::vector<float> coordinates;
};

enum class Occupancy { unknown, free, occupied };

/// Call: whether a point is occupied. Answer: PointOccupancy.
struct AskPoint {
  geometry::Point3 point;
};

struct PointOccupancy {
  Occupancy occupancy = Occupancy::unknown;
  /// 0.5 where it is unknown.
  double probability = 0.5;

  friend bool operator==(const PointOccupancy&, const PointOccupancy&) = default;
};

/// Call: what a ray meets first. Answer: RayEnd.
struct AskRay {
  geometry::Point3 origin;
  /// Of any length but 0.
  geometry::Point3 direction;
  /// Metres.
  double max_range = 10;
  /// Whether unknown space ends the ray; otherwise it counts as free.
  bool stops_at_unknown = false;
};

struct RayEnd {
  /// Free if nothing was met up to the maximal range or the border of the octree.
  Occupancy met = Occupancy::free;
  /// Centre of the voxel that was met; the end of the ray if there is none.
  geometry::Point3 point;
  /// From the origin, metres.
  double distance = 0;

  friend bool operator==(const RayEnd&, const RayEnd&) = default;
};

/// Call: whether a box is free, for instance for an arm. Answer: BoxOccupancy.
struct AskBox {
  geometry::AlignedBox box;
};

struct BoxOccupancy {
  /// Occupied if one voxel is, else unknown if one is, else free.
  Occupancy occupancy = Occupancy::unknown;
  std::int64_t occupied_voxels = 0;
  std::int64_t unknown_voxels = 0;
  std::int64_t voxels = 0;

  friend bool operator==(const BoxOccupancy&, const BoxOccupancy&) = default;
};

CASTOR_REFLECT(OctreeBlock, x, y, z, version, voxel_size, bytes)
CASTOR_REFLECT(SensedCloud, time, sensor, coordinates)
CASTOR_REFLECT_ENUM(Occupancy, unknown, free, occupied)
CASTOR_REFLECT(AskPoint, point)
CASTOR_REFLECT(PointOccupancy, occupancy, probability)
CASTOR_REFLECT(AskRay, origin, direction, max_range, stops_at_unknown)
CASTOR_REFLECT(RayEnd, met, point, distance)
CASTOR_REFLECT(AskBox, box)
CASTOR_REFLECT(BoxOccupancy, occupancy, occupied_voxels, unknown_voxels, voxels)

} // namespace castor::mapping
