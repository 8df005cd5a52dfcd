#include "castor/mapping/graph/door_detector.hpp"

#include "castor/tests/mapping/graph/two_rooms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace castor::mapping::test {

namespace {

std::string with_door(const std::string& width, const std::string& state = {}) {
  auto result = two_rooms();
  const std::string original = "width 0.9";
  return result.replace(result.find(original), original.size(), "width " + width + " " + state);
}

TEST(DoorDetector, FindsADoorFromManyPlacesToWithinSevenCentimetres) {
  Scanner scanner(two_rooms());
  int found = 0;
  int views = 0;
  for (double x = 2.5; x < 4.3; x += 0.3) {
    for (double y = 1.5; y < 3.6; y += 0.25) {
      const Pose2 robot{x, y, std::atan2(2.5 - y, 5 - x)};
      const auto openings = find_openings(scanner.scan(robot));
      ++views;
      ASSERT_LE(openings.size(), 1U) << x << " " << y;
      if (openings.empty())
        continue;
      ++found;
      const auto in_map = compose(robot, openings[0].pose());
      // The near face of the wall is 0.05 m before its middle.
      EXPECT_NEAR(in_map.x, 4.95, 0.07) << x << " " << y;
      EXPECT_NEAR(in_map.y, 2.5, 0.07) << x << " " << y;
      EXPECT_NEAR(in_map.heading, 0, 0.12) << x << " " << y;
      EXPECT_NEAR(openings[0].width(), 0.9, 0.1) << x << " " << y;
    }
  }
  EXPECT_GE(found, views * 8 / 10);
}

TEST(DoorDetector, FindsNothingThatIsTooWideOrTooNarrowOrShut) {
  const Pose2 robot{3, 2.5, 0};
  EXPECT_EQ(find_openings(Scanner(with_door("0.9")).scan(robot)).size(), 1U);
  EXPECT_TRUE(find_openings(Scanner(with_door("1.3")).scan(robot)).empty());
  EXPECT_TRUE(find_openings(Scanner(with_door("0.45")).scan(robot)).empty());
  EXPECT_TRUE(find_openings(Scanner(with_door("0.9", "shut")).scan(robot)).empty());
}

TEST(DoorDetector, TakesANicheForNoDoor) {
  // 0.9 m wide like a door, and 0.6 m deep.
  Scanner scanner(two_rooms("furniture cabinet at 5.6 2.5 box 0.1 2 2\n"));
  EXPECT_TRUE(find_openings(scanner.scan({3, 2.5, 0})).empty());
}

TEST(DoorDetector, TakesAGapBetweenRoundThingsForNoDoor) {
  Scanner scanner("building test\nwall 0 0 to 10 0 to 10 5 to 0 5 close\nroom hall at 1 1\n"
                  "furniture barrel at 5 1.85 disc 0.5 1\nfurniture barrel at 5 3.15 disc 0.5 1\n"
                  "start 1 2.5\n");
  EXPECT_TRUE(find_openings(scanner.scan({3, 2.5, 0})).empty());
}

TEST(DoorDetector, LeavesOutIgnoredBeams) {
  Scanner scanner(two_rooms());
  const auto scan = scanner.scan({3, 2.5, 0});
  EXPECT_EQ(find_openings(scan, std::vector<bool>(scan.ranges.size(), false)).size(), 1U);
  EXPECT_TRUE(find_openings(scan, std::vector<bool>(scan.ranges.size(), true)).empty());
}

TEST(DoorDetector, AnOpeningFacesAwayFromTheRobot) {
  const Opening ahead{{2, -0.45}, {2, 0.45}};
  EXPECT_NEAR(ahead.pose().heading, 0, 1e-9);
  EXPECT_NEAR(ahead.pose().x, 2, 1e-9);
  const Opening to_the_left{{0.45, 2}, {-0.45, 2}};
  EXPECT_NEAR(to_the_left.pose().heading, std::numbers::pi / 2, 1e-9);
}

} // namespace

} // namespace castor::mapping::test
