#include "castor/mapping/building/building_generator.hpp"

#include "castor/mapping/building/building_check.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/building_text.hpp"
#include "castor/mapping/building/reachable_floor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::mapping {

namespace {

GeneratorOptions options_of(std::uint64_t seed) {
  GeneratorOptions result;
  result.seed = seed;
  result.rooms = 3 + static_cast<int>(seed % 12);
  return result;
}

/// Names of the rooms that one gets to through open doors from the room of the start.
std::set<std::string> open_rooms(const Building& x) {
  std::vector<std::pair<const Room*, const Room*>> joined;
  for (const auto& door : x.doors) {
    if (!door.is_open)
      continue;
    const auto& wall = x.walls[door.wall].middle;
    const auto middle = point_at(door.opening, 0.5);
    const double across_x = -(wall.to.y - wall.from.y) / length(wall);
    const double across_y = (wall.to.x - wall.from.x) / length(wall);
    joined.emplace_back(room_at(x, {middle.x + 0.3 * across_x, middle.y + 0.3 * across_y}),
                        room_at(x, {middle.x - 0.3 * across_x, middle.y - 0.3 * across_y}));
  }
  std::set<std::string> result{room_at(x, {x.start.x, x.start.y})->name};
  for (std::size_t before = 0; before != result.size();) {
    before = result.size();
    for (auto [a, b] : joined)
      if (result.contains(a->name) || result.contains(b->name)) {
        result.insert(a->name);
        result.insert(b->name);
      }
  }
  return result;
}

} // namespace

TEST(BuildingGenerator, MakesBuildingsWithoutAProblem) {
  int shut = 0;
  int loops = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto options = options_of(seed);
    const auto x = generate_building(options);
    EXPECT_EQ(x.rooms.size(), static_cast<std::size_t>(options.rooms) + 1);
    const auto read = parse_building(building_text(x), "generated.building");
    EXPECT_TRUE(read.problems.empty()) << "seed " << seed << "\n" << render(read.problems);
    shut +=
      static_cast<int>(std::ranges::count_if(x.doors, [](auto& door) { return !door.is_open; }));
    loops += !x.rooms.back().holes.empty();
  }
  EXPECT_GT(shut, 50);
  EXPECT_GT(loops, 50);
}

TEST(BuildingGenerator, LeavesAWayIntoAllOpenRooms) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto x = generate_building(options_of(seed));
    const ReachableFloor floor(x, checked_robot_radius + 0.03, 0.1);
    const auto open = open_rooms(x);
    for (const auto& room : x.rooms) {
      const double area = floor.area_in(x, room);
      if (open.contains(room.name))
        EXPECT_GT(area, 0.15 * room.area) << "seed " << seed << ", " << room.name;
      else
        EXPECT_EQ(area, 0) << "seed " << seed << ", " << room.name;
    }
  }
}

TEST(BuildingGenerator, MakesTheSameBuildingOfTheSameSeed) {
  EXPECT_EQ(building_text(generate_building(options_of(7))),
            building_text(generate_building(options_of(7))));
  EXPECT_NE(building_text(generate_building(options_of(7))),
            building_text(generate_building(options_of(19))));
}

TEST(BuildingGenerator, RefusesWhatCannotBeBuilt) {
  GeneratorOptions options;
  options.rooms = 1;
  EXPECT_THROW(generate_building(options), std::invalid_argument);
  options = {};
  options.least_door = 0.4;
  EXPECT_THROW(generate_building(options), std::invalid_argument);
}

TEST(BuildingText, IsReadAsTheSameBuilding) {
  for (std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const auto x = generate_building(options_of(seed));
    const auto text = building_text(x);
    const auto read = parse_building(text, "generated.building").building;
    EXPECT_EQ(building_text(read), text);
    ASSERT_EQ(read.furniture.size(), x.furniture.size());
    for (std::size_t i = 0; i < x.furniture.size(); ++i) {
      EXPECT_EQ(read.furniture[i].name, x.furniture[i].name);
      EXPECT_NEAR(distance(read.furniture[i].body.pose, x.furniture[i].body.pose), 0, 1e-4);
      EXPECT_EQ(read.furniture[i].body.colour, x.furniture[i].body.colour);
      EXPECT_EQ(read.furniture[i].has_legs, x.furniture[i].has_legs);
    }
    ASSERT_EQ(read.doors.size(), x.doors.size());
    for (std::size_t i = 0; i < x.doors.size(); ++i) {
      EXPECT_EQ(read.doors[i].is_open, x.doors[i].is_open);
      EXPECT_NEAR(distance(read.doors[i].opening.from, x.doors[i].opening.from), 0, 1e-3);
    }
    EXPECT_EQ(read.people.size(), x.people.size());
  }
}

TEST(ReachableFloor, EndsAtShutDoorsAndNarrowPassages) {
  const std::string hut = "wall 0 0 to 9 0 to 9 3 to 0 3 close\n"
                          "wall 3 0 to 3 3\nwall 6 0 to 6 3\n"
                          "door a at 3 1.5 width 0.9\n"
                          "room left at 1 1\nroom middle at 4 1\nroom right at 7 1\n"
                          "start 1 1.5\n";
  const auto shut = parse_building(hut + "door b at 6 1.5 width 0.9 shut\n", "x").building;
  const ReachableFloor floor(shut);
  EXPECT_TRUE(floor.can_be_at({4.5, 1.5}));
  EXPECT_FALSE(floor.can_be_at({7.5, 1.5}));
  EXPECT_FALSE(floor.can_be_at({-5, 1.5}));
  // Two rooms of 2.9 m x 2.9 m, less what is in the corners, and the door.
  EXPECT_NEAR(floor.covered_area(), 2 * 2.9 * 2.9, 0.5);
  EXPECT_NEAR(floor.area_in(shut, shut.rooms[0]), 2.4 * 2.4, 0.3);
  const auto narrow = parse_building(hut + "door b at 6 1.5 width 0.48\n", "x").building;
  EXPECT_FALSE(ReachableFloor(narrow).can_be_at({7.5, 1.5}));
  EXPECT_TRUE(ReachableFloor(narrow, 0.2).can_be_at({7.5, 1.5}));
}

} // namespace castor::mapping
