#pragma once

#include "castor/mapping/building/building_check.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace castor::mapping {

/// Where a round robot can go from the building's start, in cells. People are not in its way.
class ReachableFloor {
public:
  /// @param radius of the robot, metres
  /// @param cell side of a cell, metres
  /// \pre complete_building() has found no error in the building.
  explicit ReachableFloor(const Building& x, double radius = checked_robot_radius,
                          double cell = 0.05);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell() const { return cell_; }
  Point2 centre(int column, int row) const;
  /// Position of a cell in what is by cells; columns() * rows() are there.
  std::size_t position(int column, int row) const;

  /// Whether the robot's middle can be at the centre of the cell.
  bool can_be_at(int column, int row) const { return reachable_[position(column, row)] != 0; }
  /// The same for the cell of a point; false outside.
  bool can_be_at(const Point2& p) const;

  /// Whether the robot's footprint covers the centre of the cell at some place where it can be:
  /// what has to be seen of the floor.
  bool can_cover(int column, int row) const { return covered_[position(column, row)] != 0; }

  /// Square metres that the footprint can cover.
  double covered_area() const;

  /// Square metres within the room where the robot's middle can be.
  double area_in(const Building& x, const Room& room) const;

private:
  Point2 low_;
  double cell_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> reachable_;
  std::vector<std::uint8_t> covered_;
};

} // namespace castor::mapping
