#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace castor::mapping {

/// Cells of a map that a round robot can be in, with the way to each.
class FreeFloor {
public:
  struct Options {
    /// From the middle of the robot to what is occupied, metres.
    double clearance = 0.3;
    /// Of the robot's footprint, metres. It bounds where the robot may get at all.
    double radius = 0.25;
    /// Cells up to that probability are free, percent. What is neither free nor unknown is in the
    /// way.
    int free_at_most = 49;
    /// If the robot is where it could not be by the map, it begins in the nearest cell where it
    /// can, at most so far away, metres.
    double greatest_start_distance = 1;
  };

  /// @param map of any size, kept as a reference: it has to outlive this object
  FreeFloor(const CellMap& map, const Pose2& robot, const Options& options);

  bool contains(const Cell& x) const {
    return x.column >= 0 && x.row >= 0 && x.column < map_.columns && x.row < map_.rows;
  }
  bool is_free(const Cell& x) const {
    return contains(x) && map_.at(x.column, x.row) >= 0 &&
           map_.at(x.column, x.row) <= options_.free_at_most;
  }
  bool is_unknown(const Cell& x) const { return !contains(x) || map_.at(x.column, x.row) < 0; }
  bool is_blocked(const Cell& x) const { return !is_unknown(x) && !is_free(x); }

  /// Length of the shortest way through free cells with the clearance, metres; infinite without.
  double way_to(const Cell& x) const;

  /// Whether there is a way through free cells, however narrow, from where the robot is.
  bool is_connected(const Cell& x) const;

  /// Whether the footprint may come to cover the cell, as far as is known: there is a way for it
  /// through what is free or unknown. True outside of the map.
  bool may_cover(const Cell& x) const { return !contains(x) || coverable_[position(x)] != 0; }

  /// Whether nothing that is occupied or unknown is between two cells. The last cell may be
  /// unknown.
  bool sees(const Cell& from, const Cell& to) const;

  Cell cell_at(const Point2& p) const;
  Point2 centre(const Cell& x) const;

  /// Square metres that are free.
  double area() const;

private:
  std::size_t position(const Cell& x) const {
    return static_cast<std::size_t>(x.row) * static_cast<std::size_t>(map_.columns) +
           static_cast<std::size_t>(x.column);
  }
  /// Distance of each cell from the nearest one that is in the way, in cells.
  std::vector<float> distances_from_blocked() const;
  void find_standable(const std::vector<float>& distances);
  void find_coverable(const std::vector<float>& distances, const Cell& start);
  Cell start_of(const Cell& robot) const;
  void find_ways(const Cell& start);
  void find_connected(const Cell& start);

  const CellMap& map_;
  Options options_;
  std::vector<std::uint8_t> standable_;
  std::vector<std::uint8_t> connected_;
  std::vector<std::uint8_t> coverable_;
  std::vector<float> ways_;
};

} // namespace castor::mapping
