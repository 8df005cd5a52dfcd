#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace castor::mapping {

/// How far each point of a map is from the nearest occupied cell. Points are in the frame of the
/// map; metres.
class DistanceField {
public:
  /// @param map whose rows lie along the x axis of its frame
  /// @param occupied_from cells of at least this probability are occupied, percent
  explicit DistanceField(const CellMap& map, int occupied_from = 65);

  /// From the cell of the point; a kilometre outside of the map.
  float at(double x, double y) const;

  struct Slope {
    double distance = 0;
    /// By how much the distance grows with x and with y.
    double dx = 0;
    double dy = 0;
  };

  /// Between the middles of cells; nothing outside of them.
  std::optional<Slope> slope(double x, double y) const;

  double cell_size() const { return cell_; }

  /// Area of the free cells, m2.
  double free_area() const { return free_area_; }

  /// Middles of squares of that side that cover the map, of those that lie in a free cell, at least
  /// `clearance` from occupied ones.
  std::vector<Point2> free_places(double side, double clearance) const;

private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_;
  int rows_;
  double cell_;
  Pose2 origin_;
  double free_area_ = 0;
  std::vector<float> distances_;
  std::vector<bool> is_free_;
};

} // namespace castor::mapping
