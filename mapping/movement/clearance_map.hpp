#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace castor::mapping {

struct ClearanceOptions {
  /// Cells from this probability on are obstacles, percent.
  int occupied_from = 60;
  /// Whether unknown cells are obstacles, too.
  bool unknown_is_obstacle = true;
};

/// Distance of each cell of a map from the nearest obstacle, exact, in time linear in the number of
/// cells.
class ClearanceMap {
public:
  ClearanceMap() = default;
  /// \pre the rows of the map are parallel to the x axis.
  explicit ClearanceMap(const CellMap& map, const ClearanceOptions& options = {});

  /// One more obstacle, of a cell's size and `around` on all sides. Clearances up to `reach` are
  /// exact afterwards, metres; larger ones may be too large. One outside the map is ignored.
  void add_obstacle(const Point2& point, double reach, double around = 0);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell_size() const { return cell_size_; }

  /// Distance of the cell's centre from the edge of the nearest obstacle, metres; 0 in an obstacle.
  /// Off by at most 0.21 cells: an edge is taken to be half a cell from its centre in all
  /// directions. What is outside the map is no obstacle.
  double at(std::size_t cell) const { return static_cast<double>(clearance_[cell]); }
  /// The same for the cell that holds the point; 0 outside the map.
  double at(const Point2& point) const;

  /// The same between the centres of cells, interpolated in both directions; 0 where one of them is
  /// outside the map.
  double between_cells(const Point2& point) const;

  /// Position of the cell that holds the point, row by row from below; nothing outside the map.
  std::optional<std::size_t> cell_at(const Point2& point) const;
  Point2 centre(std::size_t cell) const;

private:
  int columns_ = 0;
  int rows_ = 0;
  double cell_size_ = 0.05;
  Point2 origin_;
  std::vector<float> clearance_;
};

} // namespace castor::mapping
