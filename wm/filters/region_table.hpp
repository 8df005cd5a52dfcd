#pragma once

#include "castor/wm/filters/content_access.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

namespace castor {

struct RegisteredFilter;

/// Finds the filters whose region contains a point, for points of one, two or three coordinates.
///
/// There is a grid for every power of two. A region is stored in the grid whose cells are about as
/// wide as its widest side, so in at most two cells per coordinate; a point is looked up in its
/// cell of every grid in use.
class RegionTable {
public:
  void insert(const std::vector<Interval>& region, RegisteredFilter* filter);
  void erase(const std::vector<Interval>& region, RegisteredFilter* filter);
  bool empty() const { return size_ == 0; }

  /// Calls `f` for every filter whose region contains the point, and for some whose region is near
  /// it.
  template <class F>
  void find(std::span<const double> point, F&& f) const {
    for (auto& [level, grid] : grids_) {
      Cell cell{};
      for (std::size_t i = 0; i < point.size(); ++i)
        cell[i] = cell_coordinate(point[i], level);
      if (auto found = grid.find(cell); found != grid.end())
        for (auto* filter : found->second)
          f(filter);
    }
  }

private:
  /// Index of a cell along each coordinate: a whole number, but possibly beyond the range of
  /// integers.
  using Cell = std::array<double, 3>;

  struct CellHash {
    std::size_t operator()(const Cell& x) const {
      auto h = std::hash<double>{};
      return (h(x[0]) * 31 + h(x[1])) * 31 + h(x[2]);
    }
  };

  using Grid = std::unordered_map<Cell, std::vector<RegisteredFilter*>, CellHash>;

  static double cell_coordinate(double x, int level) { return std::floor(std::ldexp(x, -level)); }

  /// Calls `f` for every cell of the region's grid that the region touches.
  template <class F>
  static void for_each_cell(const std::vector<Interval>& region, int level, F&& f);

  /// By the binary logarithm of the cells' width.
  std::map<int, Grid> grids_;
  /// Includes empty regions (low above high), which touch no cell.
  std::size_t size_ = 0;
};

} // namespace castor
