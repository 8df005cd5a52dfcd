#pragma once

#include "castor/perception/spatial/types.hpp"

#include <cstdint>
#include <vector>

namespace castor::spatial {

/// Ways in which a thing of that height can be held at a point, wherever it is between the points
/// of the grid: a bit for each. None beyond the grid; beyond its heights, those of the nearest.
/// \throws std::invalid_argument if there are not as many ways as points and heights.
std::uint32_t ways_at(const ReachableTable& reach, const GroundPoint& point, double height);

/// Ways in which it can be held at one of the points around, at one of the heights around: perhaps
/// also at the point. Empty and thrown as by ways_at.
std::uint32_t ways_around(const ReachableTable& reach, const GroundPoint& point, double height);

/// Ways in which it can be held at points where it can be held in one of these ways, too.
/// \throws as ways_at
std::uint32_t ways_by_way_of(const ReachableTable& reach, double height, std::uint32_t ways);

/// How a thing can be put at points.
class ReachOfThing {
public:
  /// @param ways in which it can be held where it is, or may be held already
  ReachOfThing(ReachableTable reach, double height, std::uint32_t ways);

  /// \throws as ways_at
  Reach at(const GroundPoint& point) const;

  /// As at(), of what is to be put from there to another point; only perhaps where it cannot be
  /// held so that both is possible.
  /// \throws as ways_at
  Reach at_and_onward(const GroundPoint& point, const GroundPoint& onward) const;

  /// In the middle of each square between the points of the grid, by rows, then columns.
  /// \throws as ways_at
  std::vector<Reach> on_squares() const;

private:
  ReachableTable reach_;
  double height_;
  std::uint32_t ways_;
  /// As it can be held somewhere where it can also be held as it is here.
  std::uint32_t ways_by_stop_;
};

} // namespace castor::spatial
