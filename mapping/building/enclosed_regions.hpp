#pragma once

#include "castor/mapping/building/polygon.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace castor::mapping {

/// A part of the floor that walls enclose.
struct EnclosedRegion {
  /// Anticlockwise, along the middle of the walls.
  Polygon outline;
  /// Walls within it that have an inside of their own.
  std::vector<Polygon> holes;
  /// Without the holes, square metres.
  double area = 0;
};

struct EnclosedRegions {
  std::vector<EnclosedRegion> regions;
  /// Ends of walls that meet no other wall.
  std::vector<Point2> free_ends;
};

/// The faces of the planar graph that the walls are. Ends of walls that are nearer to another wall
/// than `tolerance` (metres) meet it. Time and memory grow with the number of crossings.
EnclosedRegions enclosed_regions(std::span<const Segment> walls, double tolerance = 0.02);

/// Index of the region that the point is in: the smallest of those around it.
std::optional<std::size_t> region_at(const EnclosedRegions& x, const Point2& p);

} // namespace castor::mapping
