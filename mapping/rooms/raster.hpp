#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace castor::mapping {

/// Values of the cells of a map, with a margin of one cell on each side, so that each cell of the
/// map has eight neighbours. A cell is named by its position in `cells`.
template <class T>
struct Raster {
  /// Those of the map, without the margin.
  int columns = 0;
  int rows = 0;
  std::vector<T> cells;

  Raster() = default;

  Raster(int width, int height, T value)
    : columns(width), rows(height),
      cells((static_cast<std::size_t>(width) + 2) * (static_cast<std::size_t>(height) + 2), value) {
  }

  int stride() const { return columns + 2; }
  int size() const { return stride() * (rows + 2); }

  /// Of a cell of the map, or of the margin at column or row -1 and `columns` or `rows`.
  int position(int x, int y) const { return (y + 1) * stride() + x + 1; }
  int column(int position) const { return position % stride() - 1; }
  int row(int position) const { return position / stride() - 1; }

  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < columns && y < rows; }

  T& operator[](int position) { return cells[static_cast<std::size_t>(position)]; }
  const T& operator[](int position) const { return cells[static_cast<std::size_t>(position)]; }

  /// What to add to a position to get those beside it.
  std::array<int, 4> beside() const { return {-1, 1, -stride(), stride()}; }
  /// The same with the diagonal ones.
  std::array<int, 8> around() const {
    auto s = stride();
    return {-1, 1, -s, s, -s - 1, -s + 1, s - 1, s + 1};
  }
};

} // namespace castor::mapping
