#include "castor/mapping/body/map_surroundings.hpp"

#include "castor/mapping/building/grid_obstacles.hpp"
#include "castor/mapping/maps/map_server.hpp"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

/// Percent, as in map_server: what is more probable is taken for occupied.
constexpr int occupied_from = 65;

std::unique_ptr<Obstacles> obstacles_of(const CellMap& map) {
  std::vector<std::uint8_t> occupied;
  occupied.reserve(map.cells.size());
  for (auto cell : map.cells)
    occupied.push_back(cell >= occupied_from ? 1 : 0);
  return std::make_unique<GridObstacles>(std::move(occupied), map.columns, map.rows, map.cell_size,
                                         Point2{map.origin.x, map.origin.y});
}

} // namespace

BodySurroundings surroundings_in_map(const std::filesystem::path& yaml) {
  const auto map = read_map_server(yaml);
  if (map.origin.heading != 0)
    throw std::invalid_argument(yaml.string() + ": the map is turned, which no building can be; "
                                                "set the third number of its origin to 0");
  return surroundings_in_map(map);
}

BodySurroundings surroundings_in_map(const CellMap& map) {
  BodySurroundings result;
  result.obstacles = obstacles_of(map);
  result.seen = obstacles_of(map);
  result.start = {map.origin.x, map.origin.y, 0};
  return result;
}

} // namespace castor::mapping
