#include "castor/mapping/movement/pursuit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace castor::mapping {

bool is_expected(const PlanningMap& map, const Point2& seen, const PursuitOptions& options) {
  return map.clearance_of_occupied().at(seen) <= options.unexpected_from;
}

std::vector<Point2> unexpected_obstacles(const PursuitSurroundings& around,
                                         const PursuitOptions& options) {
  constexpr double body = 0.45; // metres
  const auto walks = [&](const Point2& x) {
    return std::ranges::any_of(around.movers, [&](const Mover& mover) {
      return mover.speed() >= options.movers.least_speed && distance(mover.place, x) < body;
    });
  };
  std::vector<Point2> result;
  for (auto& x : around.seen)
    if (!is_expected(around.map, x, options) && !walks(x))
      result.push_back(x);
  if (!options.passing)
    return result;
  const double bodies = options.passing->standing_radius;
  constexpr int parts = 8;
  for (const auto& mover : around.movers)
    for (int i = 0; i < parts && mover.speed() < options.movers.least_speed; ++i) {
      const double angle = 2 * std::numbers::pi * i / parts;
      result.push_back(
        {mover.place.x + bodies * std::cos(angle), mover.place.y + bodies * std::sin(angle)});
    }
  return result;
}

double place_speed(const Point2& here, bool is_narrow, const PursuitSurroundings& around,
                   const PursuitOptions& options) {
  const bool is_in_door = std::ranges::any_of(
    around.gateways, [&](auto& x) { return distance(x, here) < options.gateway_reach; });
  return is_in_door || is_narrow ? options.narrow_speed : std::numeric_limits<double>::infinity();
}

} // namespace castor::mapping
