#include "castor/benchmarks/movement/movement_world.hpp"

#include "castor/mapping/body/map_surroundings.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/building_generator.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/movement/clearance_map.hpp"

#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace castor::benchmark {

using namespace mapping;

namespace {

/// What a laser sees of the building, in cells; its surroundings are unknown.
CellMap map_of(const Building& building, const BodyOptions& options) {
  const auto [low, high] = extent(building);
  CellMap result;
  result.origin = {low.x, low.y, 0};
  result.columns = static_cast<int>(std::ceil((high.x - low.x) / result.cell_size));
  result.rows = static_cast<int>(std::ceil((high.y - low.y) / result.cell_size));
  const SolidObstacles seen(
    between_heights(solids_of(building), options.laser_height, options.laser_height));
  for (int row = 0; row < result.rows; ++row)
    for (int column = 0; column < result.columns; ++column) {
      const Point2 centre{low.x + (column + 0.5) * result.cell_size,
                          low.y + (row + 0.5) * result.cell_size};
      const bool is_occupied = seen.clearance(centre, 1) < result.cell_size / 2;
      result.cells.push_back(is_occupied ? 100 : 0);
    }
  return result;
}

/// In the middle of the open: at least a metre from everything.
Pose2 drawn_start(const CellMap& map, std::uint64_t seed) {
  const ClearanceMap clearance(map);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    if (clearance.at(i) >= 1)
      open.push_back(i);
  if (open.empty())
    throw std::invalid_argument("nowhere in the map is a metre of free floor all around; choose "
                                "another map");
  std::mt19937_64 random(seed);
  const auto start = clearance.centre(open[random() % open.size()]);
  return {start.x, start.y, 0};
}

} // namespace

MovementWorld::MovementWorld(const std::string& name, std::uint64_t start_seed) {
  constexpr std::string_view generated = "generated:";
  if (name.ends_with(".yaml")) {
    map_ = read_map_server(name);
    start_ = drawn_start(map_, start_seed);
    return;
  }
  if (name.starts_with(generated)) {
    GeneratorOptions options;
    options.seed = std::stoull(name.substr(generated.size()));
    building_ = generate_building(options);
  } else {
    building_ = load_building(name).building;
  }
  building_->people.clear();
  map_ = map_of(*building_, {});
  start_ = building_->start;
}

BodySurroundings MovementWorld::surroundings(const BodyOptions& options) const {
  auto result = building_ ? surroundings_in(*building_, options) : surroundings_in_map(map_);
  result.start = start_;
  return result;
}

} // namespace castor::benchmark
