#include "castor/tests/mapping/rooms/drawn_map.hpp"

#include <cmath>
#include <cstddef>

namespace castor::mapping::test {

namespace {

int cells(double metres, const CellMap& map) {
  return static_cast<int>(std::lround(metres / map.cell_size));
}

} // namespace

DrawnMap::DrawnMap(double length, double width) {
  map_.columns = cells(length, map_);
  map_.rows = cells(width, map_);
  map_.cells.assign(static_cast<std::size_t>(map_.columns) * static_cast<std::size_t>(map_.rows),
                    100);
}

DrawnMap& DrawnMap::free(double x, double y, double length, double width) {
  return fill(x, y, length, width, 0);
}

DrawnMap& DrawnMap::occupied(double x, double y, double length, double width) {
  return fill(x, y, length, width, 100);
}

DrawnMap& DrawnMap::unknown(double x, double y, double length, double width) {
  return fill(x, y, length, width, -1);
}

DrawnMap& DrawnMap::at(const Pose2& origin) {
  map_.origin = origin;
  return *this;
}

DrawnMap& DrawnMap::fill(double x, double y, double length, double width, std::int8_t cell) {
  for (int row = cells(y, map_); row < cells(y + width, map_); ++row)
    for (int column = cells(x, map_); column < cells(x + length, map_); ++column)
      map_.at(column, row) = cell;
  return *this;
}

} // namespace castor::mapping::test
