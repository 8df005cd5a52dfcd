#pragma once

#include "castor/mapping/grid/cell_map.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace castor::mapping::test {

/// A map as it is drawn, the highest row first: '#' occupied, '?' unknown, else free.
inline CellMap drawn_map(const std::vector<std::string>& lines, double cell_size = 0.1) {
  CellMap result;
  result.columns = static_cast<int>(lines.front().size());
  result.rows = static_cast<int>(lines.size());
  result.cell_size = cell_size;
  for (std::size_t i = lines.size(); i-- > 0;)
    for (char c : lines[i])
      result.cells.push_back(c == '#' ? 100 : c == '?' ? -1 : 0);
  return result;
}

/// An empty room with walls around it, metres.
inline CellMap empty_room(double width, double height, double cell_size = 0.05) {
  CellMap result;
  result.columns = static_cast<int>(width / cell_size + 0.5);
  result.rows = static_cast<int>(height / cell_size + 0.5);
  result.cell_size = cell_size;
  for (int row = 0; row < result.rows; ++row)
    for (int column = 0; column < result.columns; ++column)
      result.cells.push_back(
        row == 0 || column == 0 || row == result.rows - 1 || column == result.columns - 1 ? 100
                                                                                          : 0);
  return result;
}

/// Occupies the cells whose centres are in a rectangle, metres.
inline void fill(CellMap& map, double left, double bottom, double right, double top,
                 std::int8_t value = 100) {
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      const double x = (column + 0.5) * map.cell_size;
      const double y = (row + 0.5) * map.cell_size;
      if (x >= left && x <= right && y >= bottom && y <= top)
        map.at(column, row) = value;
    }
}

} // namespace castor::mapping::test
