#pragma once

#include "castor/mapping/slam/surface_points.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace castor::mapping {

/// Points of surfaces in one frame, in which the nearest one is found quickly.
class PointMap {
public:
  PointMap() = default;

  /// Points without a normal, and those that are not finite, are left out.
  explicit PointMap(const SurfacePoints& points);

  /// The nearest point within `most` m that faces about the same way as `like` (within 60 degrees,
  /// if that has a normal); null if there is none.
  const SurfacePoint* nearest(const SurfacePoint& like, double most) const;

  bool empty() const { return points_.empty(); }
  const SurfacePoints& points() const { return points_; }

private:
  std::int64_t column_of(double x) const;
  std::int64_t row_of(double y) const;

  /// Sorted by cells, row by row.
  SurfacePoints points_;
  /// Of each cell, and of the end.
  std::vector<std::uint32_t> first_;
  double left_ = 0;
  double bottom_ = 0;
  double cell_ = 1;
  std::int64_t columns_ = 0;
  std::int64_t rows_ = 0;
};

} // namespace castor::mapping
