#pragma once

#include "castor/mapping/graph/segments.hpp"
#include "castor/mapping/grid/cell_map.hpp"

#include <functional>
#include <vector>

namespace castor::mapping {

/// What a division of the map into rooms says to the navigation graph.
struct RoomSegments {
  /// Number of the segment that holds a point of the map; -1 for none, as where it is blocked.
  std::function<int(const Point2&)> at;
  /// Where two segments meet, from wall to wall.
  std::vector<Line2> openings;
};

/// By segment_rooms() with its defaults.
RoomSegments room_segments(const CellMap& map);

} // namespace castor::mapping
