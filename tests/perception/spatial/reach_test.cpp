#include "castor/perception/spatial/reach.hpp"

#include "castor/perception/spatial/table_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

namespace castor::spatial {

namespace {

/// Two heights, two rows, three columns, 10 cm apart, from the middle of the table.
ReachableTable reach() {
  ReachableTable result;
  result.step = 0.1;
  result.columns = 3;
  result.rows = 2;
  result.heights = {0.02, 0.06};
  result.ways = {0b111, 0b011, 0b001, 0b111, 0b010, 0b000,  // low
                 0b110, 0b110, 0b110, 0b110, 0b110, 0b110}; // high
  return result;
}

/// Directly there, and nowhere else.
template <class Predicate>
std::function<Reach(const GroundPoint&)> where(Predicate is_reached) {
  return [is_reached](const GroundPoint& x) { return is_reached(x) ? Reach::direct : Reach::none; };
}

} // namespace

TEST(Reach, WaysAreThoseOfAllPointsAndHeightsAround) {
  const auto x = reach();
  EXPECT_EQ(ways_at(x, {0, 0}, 0.02), 0b111U);
  EXPECT_EQ(ways_at(x, {0.05, 0}, 0.02), 0b011U);
  EXPECT_EQ(ways_at(x, {0.05, 0.05}, 0.02), 0b010U);
  EXPECT_EQ(ways_at(x, {0.15, 0.05}, 0.02), 0U);
  EXPECT_EQ(ways_at(x, {0.15, 0.05}, 0.06), 0b110U);
  EXPECT_EQ(ways_at(x, {0, 0}, 0.04), 0b110U);
  EXPECT_EQ(ways_at(x, {0.2, 0.1}, 0.06), 0b110U);
}

TEST(Reach, BeyondTheHeightsTheNearestCountAndBeyondTheGridNothing) {
  const auto x = reach();
  EXPECT_EQ(ways_at(x, {0, 0}, 0.01), 0b111U);
  EXPECT_EQ(ways_at(x, {0, 0}, 0.2), 0b110U);
  for (const auto& beyond : {GroundPoint{-0.01, 0}, {0.21, 0}, {0, -0.01}, {0, 0.11}})
    EXPECT_EQ(ways_at(x, beyond, 0.02), 0U);
}

TEST(Reach, WaysAroundAreThoseOfAnyPointAndHeightAround) {
  const auto x = reach();
  EXPECT_EQ(ways_around(x, {0.2, 0}, 0.02), 0b001U);
  EXPECT_EQ(ways_around(x, {0.15, 0.05}, 0.02), 0b011U);
  EXPECT_EQ(ways_around(x, {0.15, 0.05}, 0.04), 0b111U);
  EXPECT_EQ(ways_around(x, {0.21, 0}, 0.02), 0U);
}

TEST(Reach, WaysByWayOfOthersAreThoseOfPointsThatShareOne) {
  const auto x = reach();
  EXPECT_EQ(ways_by_way_of(x, 0.02, 0b100), 0b111U);
  EXPECT_EQ(ways_by_way_of(x, 0.06, 0b100), 0b110U);
  EXPECT_EQ(ways_by_way_of(x, 0.06, 0b001), 0U);
  EXPECT_EQ(ways_by_way_of(x, 0.02, 0), 0U);
}

TEST(Reach, NeedsAWayForEachPoint) {
  auto x = reach();
  x.ways.pop_back();
  EXPECT_THROW(ways_at(x, {0, 0}, 0.02), std::invalid_argument);
  EXPECT_THROW(ways_at({}, {0, 0}, 0.02), std::invalid_argument);
}

TEST(Reach, IsDirectWhereAThingCanBeHeldAsItIs) {
  const ReachOfThing low{reach(), 0.02, 0b001};
  EXPECT_EQ(low.at({0, 0}), Reach::direct);
  EXPECT_EQ(low.at({0.05, 0}), Reach::direct);
  // Put down at one of the other points, it can be held in the second way.
  EXPECT_EQ(low.at({0, 0.1}), Reach::direct);
  EXPECT_EQ(low.at({0.1, 0.1}), Reach::by_stop);
  EXPECT_EQ(low.at({0.15, 0.05}), Reach::perhaps);
  EXPECT_EQ(low.at({0.2, 0.1}), Reach::none);
  EXPECT_EQ((ReachOfThing{reach(), 0.06, 0b001}).at({0, 0}), Reach::perhaps);
}

TEST(Reach, OnSquaresIsThatInTheirMiddles) {
  const ReachOfThing low{reach(), 0.02, 0b001};
  EXPECT_EQ(low.on_squares(), (std::vector{low.at({0.05, 0.05}), low.at({0.15, 0.05})}));
}

TEST(Reach, ThingsArePutWhereItIs) {
  const std::vector<TableObject> objects{{{-0.2, 0}, 0.03}, {{0, 0}, 0.03}};
  const std::vector wanted{PlaceWanted{"right", {1}}};
  PlacingOptions options;
  const auto anywhere = TablePlaces{objects, {0, -0.6}, options}.find(0, wanted, 3);
  options.reach = where([](const GroundPoint& x) { return x.x > 0.15; });
  const auto reached = TablePlaces{objects, {0, -0.6}, options}.find(0, wanted, 3);
  ASSERT_FALSE(anywhere.targets.empty());
  EXPECT_LT(anywhere.targets.front().position.x, 0.15);
  ASSERT_FALSE(reached.targets.empty());
  for (const auto& x : reached.targets)
    EXPECT_GT(x.position.x, 0.15);
}

TEST(Reach, WhereItIsNotKnownComesLast) {
  const std::vector<TableObject> objects{{{-0.2, 0}, 0.03}, {{0, 0}, 0.03}};
  const std::vector wanted{PlaceWanted{"right", {1}}};
  PlacingOptions options;
  options.reach = [](const GroundPoint& x) {
    return x.x > 0.2 ? Reach::direct : x.x > 0.1 ? Reach::perhaps : Reach::none;
  };
  const auto found = TablePlaces{objects, {0, -0.6}, options}.find(0, wanted, 30).targets;
  ASSERT_GE(found.size(), 3U);
  EXPECT_GT(found.front().position.x, 0.2);
  EXPECT_LE(found.back().position.x, 0.2);
  EXPECT_TRUE(std::ranges::is_partitioned(found, [](const auto& x) { return x.position.x > 0.2; }));
}

TEST(Reach, WhereThereIsLittleRoomComesLast) {
  const std::vector between{PlaceWanted{"between", {1, 2}}};
  const std::vector<TableObject> objects{
    {{-0.2, -0.2}, 0.03}, {{-0.07, 0}, 0.03}, {{0.07, 0}, 0.03}};
  PlacingOptions options;
  EXPECT_EQ((TablePlaces{objects, {0, -0.6}, options}.find(0, between).reason), "there is no room");
  options.least_clearance = 0.005;
  const auto found = TablePlaces{objects, {0, -0.6}, options}.find(0, between).targets;
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found.front().position.x, 0, 0.01);
}

TEST(Reach, ItIsSaidThatItIsWhatLacks) {
  const std::vector<TableObject> objects{{{-0.2, 0}, 0.03}, {{0.1, 0}, 0.2}};
  const std::vector right{PlaceWanted{"right", {}}};
  PlacingOptions options;
  options.reach = where([](const GroundPoint& x) { return x.x < 0; });
  EXPECT_EQ((TablePlaces{objects, {0, -0.6}, options}.find(0, right).reason),
            "I do not reach any such place with it");
  // What stands there leaves room at the corners only.
  options.reach = where([](const GroundPoint& x) { return distance(x, {0.1, 0}) < 0.2; });
  EXPECT_EQ((TablePlaces{objects, {0, -0.6}, options}.find(0, right).reason),
            "there is no room where I reach");
}

} // namespace castor::spatial
