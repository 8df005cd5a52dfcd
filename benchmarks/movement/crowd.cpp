#include "castor/benchmarks/movement/crowd.hpp"

#include "castor/mapping/movement/path_planner.hpp"

#include <cstddef>
#include <random>
#include <string>
#include <utility>

namespace castor::benchmark {

using namespace mapping;

std::vector<Walker> crowd(const CellMap& map, const Point2& robot, int count, std::uint64_t seed) {
  PlanOptions options;
  options.explains = false;
  const ClearanceMap clearance(map, options.cells);
  std::vector<std::size_t> floor;
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    if (clearance.at(i) >= options.radius + options.margin)
      floor.push_back(i);
  std::mt19937_64 random(seed);
  const auto drawn = [&] { return clearance.centre(floor[random() % floor.size()]); };
  std::vector<Walker> result;
  constexpr double apart = 2;    // metres
  constexpr double shortest = 4; // metres
  constexpr int attempts = 200;
  for (int i = 0; i < attempts && static_cast<int>(result.size()) < count; ++i) {
    const auto from = drawn();
    const auto to = drawn();
    if (distance(from, robot) < apart ||
        plan_path(map, clearance, robot, from, options).points.empty())
      continue;
    auto way = plan_path(map, clearance, from, to, options);
    if (way.length < shortest)
      continue;
    Walker person;
    person.name = "walker-" + std::to_string(result.size() + 1);
    person.route = std::move(way.points);
    person.speed = 0.4 + 0.1 * static_cast<double>(random() % 7);
    result.push_back(std::move(person));
  }
  return result;
}

} // namespace castor::benchmark
