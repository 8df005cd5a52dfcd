#pragma once

#include "castor/mapping/movement/clearance_map.hpp"

#include <string>
#include <vector>

namespace castor::mapping {

struct PlanOptions {
  /// Of the robot's footprint, and what is kept between it and obstacles; metres.
  double radius = 0.25;
  double margin = 0.05;
  /// A way with less clearance than this counts as longer, metres: by at most `narrowness` times
  /// its length, where there is just enough.
  double preferred_clearance = 0.6;
  double narrowness = 0.5;
  /// A start without enough clearance is left for the nearest place with it, at most so far away,
  /// metres.
  double start_tolerance = 0.4;
  /// Where there is no way with the margin, one may do that keeps only `tight_margin` so far around
  /// the start: out of a narrow place into which the robot has come, before the map showed that it
  /// is narrower than it seemed. Metres; 0: never.
  double escape = 1.5;
  double tight_margin = 0.02;
  ClearanceOptions cells;
  /// Whether it says what blocks the way where there is none. To find that takes longer than to
  /// plan.
  bool explains = true;
};

struct PlannedPath {
  /// From the start to the goal; empty if there is no way.
  std::vector<Point2> points;
  /// Metres.
  double length = 0;
  /// Why there is no way.
  std::string reason;
};

/// Plans the way of a disc over a map: A* over eight neighbours, then straight shortcuts wherever
/// they cost no more. The cost of the way is at most 1.083 times that of the cheapest, the factor
/// between a straight line and its way over eight neighbours; so its length is at most
/// 1.083 (1 + narrowness) times the shortest, and without narrow places 1.083 times.
/// @param clearance of `map`, with the same options
PlannedPath plan_path(const CellMap& map, const ClearanceMap& clearance, const Point2& start,
                      const Point2& goal, const PlanOptions& options = {});

/// Whether a straight way keeps that clearance, looked at each half cell.
bool is_clear(const ClearanceMap& clearance, const Point2& a, const Point2& b, double least);

} // namespace castor::mapping
