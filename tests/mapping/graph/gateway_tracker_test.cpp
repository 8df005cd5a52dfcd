#include "castor/mapping/graph/gateway_tracker.hpp"

#include "castor/tests/mapping/graph/two_rooms.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace castor::mapping::test {

namespace {

void look(GatewayTracker& tracker, Scanner& scanner, const std::vector<Pose2>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto scan = scanner.scan(poses[i]);
    tracker.add(static_cast<std::int64_t>(i), poses[i], scan, find_openings(scan));
  }
}

TEST(GatewayTracker, SeveralViewsConfirmADoorAtItsTruePlace) {
  Scanner scanner(two_rooms());
  GatewayTracker tracker;
  look(tracker, scanner, {{2, 2.5, 0}});
  ASSERT_EQ(tracker.gateways().size(), 1U);
  EXPECT_FALSE(tracker.gateways().begin()->second.is_confirmed);
  GatewayTracker both_sides;
  auto poses = poses_along({{2, 2.5}, {4, 2.5}});
  auto back = poses_along({{8, 2.5}, {6, 2.5}});
  poses.insert(poses.end(), back.begin(), back.end());
  look(both_sides, scanner, poses);
  ASSERT_EQ(both_sides.gateways().size(), 1U);
  auto& door = both_sides.gateways().begin()->second;
  EXPECT_TRUE(door.is_confirmed);
  EXPECT_NEAR(door.pose.x, 5, 0.03);
  EXPECT_NEAR(door.pose.y, 2.5, 0.03);
  EXPECT_NEAR(door.width, 0.9, 0.05);
}

TEST(GatewayTracker, ViewsFromOnePlaceAreOne) {
  Scanner scanner(two_rooms());
  GatewayTracker tracker;
  look(tracker, scanner, std::vector<Pose2>(10, {3, 2.5, 0}));
  EXPECT_FALSE(tracker.gateways().begin()->second.is_confirmed);
}

TEST(GatewayTracker, ViewsThatDoNotShowItRefuteADoor) {
  Scanner with_door(two_rooms());
  GatewayTracker tracker;
  look(tracker, with_door, poses_along({{2, 2.5}, {3, 2.5}}));
  ASSERT_TRUE(tracker.gateways().begin()->second.is_confirmed);
  // What looked like a door was the gap between two things that are gone.
  Scanner hall("building test\nwall 0 0 to 10 0 to 10 5 to 0 5 close\nroom hall at 1 1\n"
               "start 1 2.5\n");
  for (int i = 0; i < 30; ++i)
    look(tracker, hall, {{2.5 + 0.15 * (i % 10), 2.2 + 0.2 * (i / 10), 0}});
  EXPECT_FALSE(tracker.gateways().begin()->second.is_confirmed);
}

TEST(GatewayTracker, AShutDoorRefutesNothing) {
  Scanner open(two_rooms());
  GatewayTracker tracker;
  look(tracker, open, poses_along({{2, 2.5}, {3, 2.5}}));
  auto text = two_rooms();
  text.replace(text.find("width 0.9"), 9, "width 0.9 shut");
  Scanner shut(text);
  for (int i = 0; i < 30; ++i)
    look(tracker, shut, {{2.5 + 0.15 * (i % 10), 2.2 + 0.2 * (i / 10), 0}});
  EXPECT_TRUE(tracker.gateways().begin()->second.is_confirmed);
}

TEST(GatewayTracker, FollowsCorrectionsAndMergesWhatIsAtOnePlaceThen) {
  Scanner scanner(two_rooms());
  GatewayTracker tracker;
  const auto poses = poses_along({{2, 2.5}, {3.5, 2.5}});
  look(tracker, scanner, poses);
  // The same way again, after a drift of a metre.
  const auto count = static_cast<std::int64_t>(poses.size());
  for (std::int64_t i = 0; i < count; ++i) {
    const auto& truth = poses[static_cast<std::size_t>(i)];
    const auto scan = scanner.scan(truth);
    tracker.add(count + i, compose({0, 1, 0}, truth), scan, find_openings(scan));
  }
  EXPECT_EQ(tracker.gateways().size(), 2U);
  tracker.correct([&](std::int64_t i) {
    return compose({10, 0, 0}, poses[static_cast<std::size_t>(i % count)]);
  });
  ASSERT_EQ(tracker.gateways().size(), 1U);
  EXPECT_EQ(tracker.gateways().begin()->first, 0);
  EXPECT_NEAR(tracker.gateways().begin()->second.pose.x, 14.95, 0.05);
}

TEST(GatewayTracker, ASecondSourceConfirmsOrDoubts) {
  Scanner scanner(two_rooms());
  GatewayTracker tracker;
  look(tracker, scanner, {{2, 2.5, 0}});
  tracker.support(0, true);
  EXPECT_TRUE(tracker.gateways().at(0).is_confirmed);
  tracker.support(0, false);
  EXPECT_FALSE(tracker.gateways().at(0).is_confirmed);
}

} // namespace

} // namespace castor::mapping::test
