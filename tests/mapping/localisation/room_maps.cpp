#include "castor/tests/mapping/localisation/room_maps.hpp"

#include <cmath>

namespace castor::mapping::test {

namespace {

/// Metres, from the corner of the room.
void fill(CellMap& map, double left, double bottom, double right, double top) {
  auto cells = [&map](double metres) {
    return static_cast<int>(std::lround((metres + 0.5) / map.cell_size));
  };
  for (int row = cells(bottom); row < cells(top); ++row)
    for (int column = cells(left); column < cells(right); ++column)
      map.at(column, row) = 100;
}

} // namespace

CellMap symmetric_map() {
  CellMap map;
  map.columns = 220;
  map.rows = 180;
  map.cell_size = 0.05;
  map.origin = {-0.5, -0.5, 0};
  map.cells.assign(220 * 180, -1);
  for (int row = 10; row < 170; ++row)
    for (int column = 10; column < 210; ++column)
      map.at(column, row) = 0;
  fill(map, -0.2, -0.2, 10.2, 0);
  fill(map, -0.2, 8, 10.2, 8.2);
  fill(map, -0.2, 0, 0, 8);
  fill(map, 10, 0, 10.2, 8);
  return map;
}

CellMap furnished_map() {
  auto map = symmetric_map();
  fill(map, 3, 3, 7, 5);
  fill(map, 0.2, 0, 1.2, 0.6);
  fill(map, 4, 0, 5.5, 0.4);
  fill(map, 9.4, 2, 10, 3.5);
  fill(map, 8, 7.5, 9, 8);
  fill(map, 2, 7, 2.6, 8);
  fill(map, 0, 4, 0.5, 6);
  return map;
}

} // namespace castor::mapping::test
