#include "castor/mapping/building/building_generator.hpp"

#include "castor/mapping/building/building_check.hpp"
#include "castor/mapping/building/floor_furnishing.hpp"
#include "castor/mapping/building/floor_layout.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

void expect_range(bool is_fine, const char* what) {
  if (!is_fine)
    throw std::invalid_argument(std::string{"generated building: "} + what);
}

void check_options(const GeneratorOptions& x) {
  expect_range(x.rooms >= 2 && x.rooms <= 60, "the number of rooms has to be 2 to 60");
  expect_range(x.least_side >= 2.5 && x.greatest_side >= x.least_side && x.greatest_side <= 20,
               "sides of rooms have to be 2.5 to 20 m, the least one first");
  expect_range(x.least_corridor >= 1 && x.greatest_corridor >= x.least_corridor &&
                 x.greatest_corridor <= 10,
               "corridors have to be 1 to 10 m wide, the least width first");
  expect_range(x.least_door >= 0.7 && x.greatest_door >= x.least_door && x.greatest_door <= 1.5,
               "doors have to be 0.7 to 1.5 m wide, the least width first");
  expect_range(x.furniture >= 0 && x.objects >= 0 && x.walkers >= 0 && x.furniture <= 20 &&
                 x.objects <= 20 && x.walkers <= 20,
               "numbers of furniture, objects and walkers have to be 0 to 20");
}

bool is_along_x(const Rectangle& part) {
  return part.length() >= part.width();
}

/// On the middle line of a part of the corridor, at a share of its length.
Point2 on_middle_line(const Rectangle& part, double share) {
  // From its ends, metres.
  constexpr double inset = 0.7;
  const auto middle = part.middle();
  const auto at = [&](double low, double high) {
    return std::round((low + inset + share * (high - low - 2 * inset)) * 100) / 100;
  };
  return is_along_x(part) ? Point2{at(part.low.x, part.high.x), middle.y}
                          : Point2{middle.x, at(part.low.y, part.high.y)};
}

class WalkerRoutes {
public:
  /// @param completed the building, whose doors know their walls
  explicit WalkerRoutes(const Building& completed)
    : building_(completed),
      obstacles_(between_heights(solids_of(completed), 0, checked_robot_height)) {
    // nop
  }

  /// From one side of an open door to the other; empty if something is in the way.
  std::vector<Point2> through(const Door& door) const {
    const auto& wall = building_.walls[door.wall].middle;
    const double whole = length(wall);
    const auto middle = point_at(door.opening, 0.5);
    constexpr double away = 0.85; // metres
    const Point2 across{-(wall.to.y - wall.from.y) / whole * away,
                        (wall.to.x - wall.from.x) / whole * away};
    std::vector<Point2> result{{middle.x + across.x, middle.y + across.y},
                               {middle.x - across.x, middle.y - across.y}};
    return is_free(result) ? result : std::vector<Point2>{};
  }

  bool is_free(const std::vector<Point2>& route) const {
    constexpr double step = 0.05;
    constexpr double body = 0.3;
    for (std::size_t i = 0; i + 1 < route.size(); ++i) {
      const Segment part{route[i], route[i + 1]};
      for (double at = 0; at <= length(part); at += step)
        if (obstacles_.clearance(point_at(part, at / length(part)), 1) < body)
          return false;
    }
    return true;
  }

private:
  const Building& building_;
  SolidObstacles obstacles_;
};

void add_walkers(FloorLayout& floor, const GeneratorOptions& options, SeededUniform& random) {
  auto completed = floor.building;
  complete_building(completed);
  const WalkerRoutes routes(completed);
  for (int i = 0; i < options.walkers; ++i) {
    std::vector<Point2> route;
    if (i % 2 == 0) {
      const auto& part = floor.corridor[random.below(floor.corridor.size())];
      route = {on_middle_line(part, 0), on_middle_line(part, 1)};
    } else {
      const auto& door = completed.doors[random.below(completed.doors.size())];
      if (door.is_open)
        route = routes.through(door);
    }
    const double speed = std::round(random.between(0.4, 0.9) * 100) / 100;
    if (route.empty() || !routes.is_free(route))
      continue;
    auto& walker = floor.building.people.emplace_back();
    walker.name = "walker-" + std::to_string(i + 1);
    walker.route = std::move(route);
    walker.speed = speed;
  }
}

} // namespace

Building generate_building(const GeneratorOptions& options) {
  check_options(options);
  SeededUniform random(options.seed);
  auto floor = lay_out_floor(options, random);
  furnish_floor(floor, options, random);
  const auto& part = floor.corridor[random.below(floor.corridor.size())];
  const auto start = on_middle_line(part, random.between(0, 1));
  floor.building.start = {start.x, start.y, is_along_x(part) ? 0 : std::numbers::pi / 2};
  add_walkers(floor, options, random);
  for (const auto& remark : complete_building(floor.building))
    if (remark.is_error)
      throw std::logic_error("the generated building of seed " + std::to_string(options.seed) +
                             " is wrong: " + remark.message);
  return std::move(floor.building);
}

} // namespace castor::mapping
