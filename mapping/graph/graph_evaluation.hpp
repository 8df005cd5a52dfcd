#pragma once

#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace castor::mapping {

/// A door as the building has it.
struct TrueDoor {
  std::string name;
  Point2 middle;
  double width = 0;
  bool is_open = true;
  /// Whether the robot has seen it: what it has not is not missed.
  bool was_seen = true;
};

struct GraphQuality {
  std::size_t places = 0;
  std::size_t rooms = 0;
  std::size_t areas = 0;
  /// Share of the places of a room that are in that area which has most of them, and of the places
  /// of an area that are in that room; over all places.
  double area_recall = 0;
  double area_precision = 0;
  /// Open doors that were seen, and those of them that are no gateways.
  std::size_t doors_seen = 0;
  std::vector<std::string> doors_missed;
  std::size_t doors_found = 0;
  /// Gateways that are no doors.
  std::vector<Point2> doors_invented;
  /// Distances of gateways from the middles of their doors, metres, and differences of widths.
  double door_error_median = 0;
  double door_error_most = 0;
  double width_error_median = 0;
};

/// Compares a graph with the building.
/// @param room_at name of the room at a point; empty for none
/// @param near a gateway is a door if it is at most this far from its middle, metres
GraphQuality evaluate(const std::vector<GraphNode>& nodes,
                      const std::function<std::string(const Point2&)>& room_at,
                      const std::vector<TrueDoor>& doors, double near = 0.4);

} // namespace castor::mapping
