#include "castor/mapping/localisation/place_tracker.hpp"

#include "castor/benchmarks/localisation/wandering_robot.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/tests/mapping/localisation/room_maps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace castor::mapping::test {

namespace {

using localisation_benchmark::WanderingRobot;

PlaceTracker tracker_in(const CellMap& map) {
  return {std::make_shared<const DistanceField>(map), {}};
}

TEST(PlaceTracker, OnePlaceIsLeftWhereNoTwoLookAlike) {
  const auto map = furnished_map();
  auto tracker = tracker_in(map);
  WanderingRobot robot{map, {1.5, 2, 0.3}};
  for (int i = 0; i < 200; ++i) {
    robot.drive();
    tracker.add(robot.scan(), robot.odometry());
  }
  ASSERT_EQ(tracker.places().size(), 1U);
  EXPECT_LT(distance(tracker.places()[0].pose, robot.truth()), 0.1);
  EXPECT_EQ(tracker.rivals(robot.truth()), 0U);
  EXPECT_EQ(tracker.rivals({8, 2, 0}), 1U);
}

TEST(PlaceTracker, TwoAreLeftWhereTwoLookAlike) {
  const auto map = symmetric_map();
  auto tracker = tracker_in(map);
  WanderingRobot robot{map, {1.5, 2, 0.3}};
  std::size_t least = 100;
  for (int i = 0; i < 300; ++i) {
    robot.drive();
    tracker.add(robot.scan(), robot.odometry());
    least = std::min(least, tracker.places().size());
    ASSERT_GE(tracker.rivals(robot.truth()), 1U) << i;
  }
  EXPECT_EQ(least, 2U);
}

TEST(PlaceTracker, SearchesAtOnceAndThenAfterSomeWay) {
  const auto map = furnished_map();
  auto tracker = tracker_in(map);
  WanderingRobot robot{map, {1.5, 2, 0.3}};
  EXPECT_TRUE(tracker.add(robot.scan(), robot.odometry()));
  EXPECT_FALSE(tracker.add(robot.scan(), robot.odometry()));
  int scans = 0;
  do {
    robot.drive();
    ++scans;
  } while (!tracker.add(robot.scan(), robot.odometry()) && scans < 200);
  // 2 m at 0.5 m/s.
  EXPECT_GT(scans, 20);
  EXPECT_LT(scans, 100);
}

TEST(PlaceTracker, FindsARobotThatIsCarriedAwayMeanwhile) {
  const auto map = furnished_map();
  auto tracker = tracker_in(map);
  WanderingRobot robot{map, {1.5, 2, 0.3}};
  for (int i = 0; i < 30; ++i) {
    robot.drive();
    tracker.add(robot.scan(), robot.odometry());
  }
  robot.kidnap({8.6, 6.6, 2.5});
  for (int i = 0; i < 250; ++i) {
    robot.drive();
    tracker.add(robot.scan(), robot.odometry());
  }
  ASSERT_FALSE(tracker.places().empty());
  EXPECT_EQ(tracker.rivals(robot.truth()), 0U);
}

TEST(PlaceTracker, ForgetsAllWhenItIsRestarted) {
  const auto map = furnished_map();
  auto tracker = tracker_in(map);
  WanderingRobot robot{map, {1.5, 2, 0.3}};
  tracker.add(robot.scan(), robot.odometry());
  ASSERT_FALSE(tracker.places().empty());
  tracker.restart();
  EXPECT_TRUE(tracker.places().empty());
  EXPECT_TRUE(tracker.add(robot.scan(), robot.odometry()));
}

} // namespace

} // namespace castor::mapping::test
