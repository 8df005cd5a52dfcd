#pragma once

#include "castor/mapping/building/obstacles.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

/// Square cells that are free or occupied, as of a map that was read from a file.
class GridObstacles final : public Obstacles {
public:
  /// @param occupied columns * rows cells, row by row from the lowest y; nonzero if occupied
  /// @param cell edge of a cell, metres
  /// @param low lower left corner of the first cell
  /// \throws std::invalid_argument unless the sizes fit and are positive.
  GridObstacles(std::vector<std::uint8_t> occupied, std::int64_t columns, std::int64_t rows,
                double cell, const Point2& low);

  std::optional<double> cast(const Point2& origin, double direction,
                             double max_range) const override;
  double clearance(const Point2& p, double limit) const override;

private:
  bool is_occupied(std::int64_t column, std::int64_t row) const;

  std::vector<std::uint8_t> occupied_;
  std::int64_t columns_;
  std::int64_t rows_;
  double cell_;
  Point2 low_;
};

} // namespace castor::mapping
