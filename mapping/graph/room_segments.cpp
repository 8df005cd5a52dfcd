#include "castor/mapping/graph/room_segments.hpp"

#include "castor/mapping/rooms/room_segmentation.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace castor::mapping {

RoomSegments room_segments(const CellMap& map) {
  auto rooms = segment_rooms(map);
  RoomSegments result;
  for (auto& x : rooms.openings)
    result.openings.push_back({x.from, x.to});
  result.at = [labels = std::move(rooms.labels), columns = map.columns, rows = map.rows,
               size = map.cell_size, to_map = inverse(map.origin)](const Point2& p) {
    const auto on_map = transform(to_map, p);
    const auto column = static_cast<std::int64_t>(std::floor(on_map.x / size));
    const auto row = static_cast<std::int64_t>(std::floor(on_map.y / size));
    if (column < 0 || row < 0 || column >= columns || row >= rows)
      return -1;
    const auto label = labels[static_cast<std::size_t>(row * columns + column)];
    return label > 0 ? static_cast<int>(label) : -1;
  };
  return result;
}

} // namespace castor::mapping
