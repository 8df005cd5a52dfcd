#include "castor/mapping/slam/placed_scan.hpp"

#include "castor/tests/mapping/slam/simulated_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <vector>

namespace castor::mapping::test {

namespace {

constexpr Pose2 robot{2, 1.7, 0};

PlacedScan seen(const std::vector<Wall>& walls, const Pose2& from) {
  const auto scan = std::make_shared<const LaserScan>(scan_from(walls, from));
  return {scan, from, surface_points(*scan), {}};
}

std::vector<Wall> room_with(const Point2& person) {
  auto result = furnished_room();
  std::ranges::copy(person_at(person), std::back_inserter(result));
  return result;
}

/// How many of the points are nearer than 0.3 m to the place.
std::ptrdiff_t near(const SurfacePoints& points, const Point2& place) {
  return std::ranges::count_if(points, [&](auto& x) { return distance(x.position, place) < 0.3; });
}

constexpr Point2 place{5, 1.7};

TEST(PlacedScan, SomebodyWhoCameHasMoved) {
  auto scan = seen(room_with(place), robot);
  const auto before = near(scan.standing(), place);
  ASSERT_GT(before, 5);
  EXPECT_FALSE(scan.learn_from(seen(furnished_room(), {1.9, 1.7, 0}).view()));
  EXPECT_EQ(near(scan.standing(), place), before) << "one scan may err";
  EXPECT_TRUE(scan.learn_from(seen(furnished_room(), {1.8, 1.7, 0}).view()));
  EXPECT_EQ(near(scan.standing(), place), 0);
}

TEST(PlacedScan, WhatStandsIsKept) {
  auto scan = seen(room_with(place), robot);
  const auto all = scan.standing().size();
  for (double x = 1; x < 2; x += 0.1)
    scan.learn_from(seen(room_with(place), {x, 1.8, 0.1}).view());
  EXPECT_EQ(scan.standing().size(), all);
  EXPECT_EQ(std::ranges::count(scan.moved(), true), 0);
}

TEST(PlacedScan, WhatIsHiddenIsNoEvidence) {
  // Somebody who was nearer hides the place.
  auto scan = seen(room_with(place), robot);
  for (int i = 0; i < 5; ++i)
    scan.learn_from(seen(room_with({3, 1.7}), robot).view());
  EXPECT_GT(near(scan.standing(), place), 5);
}

TEST(PlacedScan, MarksPointsInTheOrderOfTheScan) {
  auto scan = seen(room_with(place), robot);
  for (int i = 0; i < 2; ++i)
    scan.learn_from(seen(furnished_room(), robot).view());
  const auto moved = scan.moved();
  const auto points = surface_points(scan.view().scan());
  ASSERT_EQ(moved.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(moved[i], distance(transform(robot, points[i].position), place) < 0.3) << i;
}

} // namespace

} // namespace castor::mapping::test
