#pragma once

#include "castor/mapping/grid/cell_map.hpp"

namespace castor::mapping::test {

/// A map of walls in which rooms and doors are drawn, in metres from the lower left corner.
class DrawnMap {
public:
  DrawnMap(double length, double width);

  /// A free rectangle.
  DrawnMap& free(double x, double y, double length, double width);
  /// An occupied rectangle.
  DrawnMap& occupied(double x, double y, double length, double width);
  DrawnMap& unknown(double x, double y, double length, double width);
  DrawnMap& at(const Pose2& origin);

  const CellMap& map() const { return map_; }

private:
  DrawnMap& fill(double x, double y, double length, double width, std::int8_t cell);

  CellMap map_;
};

} // namespace castor::mapping::test
