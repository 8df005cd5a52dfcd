#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace castor::mapping {

/// The map without the occupied cells that a laser cannot see: those without a free cell beside
/// them become unknown. A map in which no cell can be seen stays as it is.
/// @param occupied_from cells of at least this probability are occupied, percent
CellMap visible_surfaces(const CellMap& map, int occupied_from);

/// How far each point of a map is from the nearest occupied cell, and from the nearest one that a
/// laser can see. Points are in the frame of the map; metres.
class DistanceField {
public:
  /// @param map whose rows lie along the x axis of its frame
  /// @param occupied_from cells of at least this probability are occupied, percent
  explicit DistanceField(const CellMap& map, int occupied_from = 65);

  /// From the cell of the point to the nearest occupied one; a kilometre outside of the map.
  float to_occupied(double x, double y) const { return at(to_occupied_, x, y); }

  /// The same to the nearest occupied cell that a laser can see, which is not 0 within walls.
  float to_surface(double x, double y) const { return at(to_surface_, x, y); }

  struct Slope {
    double distance = 0;
    /// By how much the distance grows with x and with y.
    double dx = 0;
    double dy = 0;
  };

  /// Of the distance to surfaces, between the middles of cells; nothing outside of them.
  std::optional<Slope> slope(double x, double y) const;

  double cell_size() const { return cell_; }

  /// Area of the free cells, m2.
  double free_area() const { return free_area_; }

  /// Middles of squares of that side that cover the map, of those that lie in a free cell, at least
  /// `clearance` from occupied ones.
  std::vector<Point2> free_places(double side, double clearance) const;

private:
  float at(const std::vector<float>& distances, double x, double y) const;
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_;
  int rows_;
  double cell_;
  Pose2 origin_;
  double free_area_ = 0;
  std::vector<float> to_occupied_;
  std::vector<float> to_surface_;
  std::vector<bool> is_free_;
};

} // namespace castor::mapping
