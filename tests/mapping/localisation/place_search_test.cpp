#include "castor/mapping/localisation/place_search.hpp"

#include "castor/benchmarks/localisation/wandering_robot.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/tests/mapping/localisation/room_maps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>

namespace castor::mapping::test {

namespace {

using localisation_benchmark::random_place;
using localisation_benchmark::WanderingRobot;

bool is_at(const Place& x, const Pose2& pose) {
  return distance(x.pose, pose) < 0.1 && std::abs(normalised(x.pose.heading - pose.heading)) < 0.05;
}

TEST(PlaceSearch, HasThePlaceOfTheRobotWhereverItIs) {
  const auto map = furnished_map();
  PlaceSearch search{std::make_shared<const DistanceField>(map), {}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    WanderingRobot robot{map, random_place(map, 0.25, seed), {.seed = seed}};
    auto found = search.find({{robot.scan(), {}}});
    ASSERT_FALSE(found.too_many) << seed;
    EXPECT_TRUE(
      std::ranges::any_of(found.places, [&](const Place& x) { return is_at(x, robot.truth()); }))
      << seed;
  }
}

TEST(PlaceSearch, OfARoomThatLooksTheSameAfterHalfATurnItHasBothPlaces) {
  const auto map = symmetric_map();
  PlaceSearch search{std::make_shared<const DistanceField>(map), {}};
  WanderingRobot robot{map, {2, 3, 0.5}};
  auto found = search.find({{robot.scan(), {}}});
  ASSERT_GE(found.places.size(), 2U);
  auto truth = robot.truth();
  Pose2 other{10 - truth.x, 8 - truth.y, truth.heading + std::numbers::pi};
  EXPECT_TRUE(is_at(found.places[0], truth) || is_at(found.places[0], other));
  EXPECT_TRUE(is_at(found.places[1], truth) || is_at(found.places[1], other));
  EXPECT_GT(found.places[1].explained, 0.95);
}

TEST(PlaceSearch, AScanInWhichNothingCameBackFitsTooManyPlaces) {
  PlaceSearch search{std::make_shared<const DistanceField>(furnished_map()), {}};
  LaserScan empty;
  empty.max_range = 10;
  empty.ranges.assign(181, 0);
  auto found = search.find({{empty, {}}});
  EXPECT_TRUE(found.too_many);
  EXPECT_TRUE(found.places.empty());
}

TEST(PlaceSearch, AScanOfAnotherBuildingHasNoPlace) {
  PlaceSearch search{std::make_shared<const DistanceField>(furnished_map()), {}};
  LaserScan far_away;
  far_away.first_angle = -1.57;
  far_away.angle_step = 0.0174;
  far_away.max_range = 40;
  far_away.ranges.assign(181, 30);
  auto found = search.find({{far_away, {}}});
  EXPECT_FALSE(found.too_many);
  EXPECT_TRUE(found.places.empty());
}

TEST(DistinctPlaces, TheMostExplainedOfNearOnesIsLeft) {
  auto places = distinct_places(
    {{{0, 0, 0}, 0.7}, {{0.1, 0, 0}, 0.9}, {{0, 0, 3.1}, 0.8}, {{0, 0.1, -3.1}, 0.6}}, 0.3, 0.3);
  ASSERT_EQ(places.size(), 2U);
  EXPECT_DOUBLE_EQ(places[0].explained, 0.9);
  EXPECT_DOUBLE_EQ(places[1].explained, 0.8);
}

} // namespace

} // namespace castor::mapping::test
