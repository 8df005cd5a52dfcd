#include "castor/mapping/slam/narrow_things.hpp"

#include "castor/tests/mapping/slam/simulated_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace castor::mapping::test {

namespace {

// From the middle of the near end of a corridor of 20 m x 3 m, along it.
const Pose2 here{1, 1.5, 0};

std::vector<Wall> corridor() {
  return {{{0, 0}, {20, 0}}, {{0, 3}, {20, 3}}, {{20, 0}, {20, 3}}, {{0, 0}, {0, 3}}};
}

std::vector<Wall> corridor_with(const std::vector<Wall>& things) {
  auto result = corridor();
  std::ranges::copy(things, std::back_inserter(result));
  return result;
}

TEST(NarrowThings, SomebodyIsNarrow) {
  const auto scan = scan_from(corridor_with(person_at({3, 1.2})), here);
  const auto walls = scan_from(corridor(), here);
  const auto left = without_narrow_things(scan);
  std::size_t without = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const bool is_person = scan.ranges[i] != walls.ranges[i];
    EXPECT_EQ(left.ranges[i], is_person ? 0 : scan.ranges[i]) << i;
    without += is_person ? 1 : 0;
  }
  EXPECT_GT(without, 10u);
}

TEST(NarrowThings, WhoIsPartlyHiddenBySomebodyIsNarrow) {
  auto people = person_at({3, 1.2});
  std::ranges::copy(person_at({5, 0.9}), std::back_inserter(people));
  const auto scan = scan_from(corridor_with(people), here);
  const auto walls = scan_from(corridor(), here);
  const auto left = without_narrow_things(scan);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    EXPECT_EQ(left.ranges[i], scan.ranges[i] != walls.ranges[i] ? 0 : scan.ranges[i]) << i;
}

TEST(NarrowThings, WallsAndWhatIsWiderStay) {
  const auto walls = scan_from(corridor(), here);
  EXPECT_EQ(without_narrow_things(walls), walls);
  const auto cabinet = scan_from(corridor_with({{{4, 0.8}, {4, 2.2}}}), here);
  EXPECT_EQ(without_narrow_things(cabinet), cabinet);
}

TEST(NarrowThings, AWallBetweenTwoPeopleStays) {
  auto people = person_at({3, 1});
  std::ranges::copy(person_at({3, 2}), std::back_inserter(people));
  const auto scan = scan_from(corridor_with(people), here);
  // The end of the corridor is seen between them, less than a metre of it.
  const auto ahead = scan.ranges.size() / 2;
  ASSERT_NEAR(scan.ranges[ahead], 19, 0.1);
  EXPECT_EQ(without_narrow_things(scan).ranges[ahead], scan.ranges[ahead]);
}

TEST(NarrowThings, AtTheEdgeOfTheViewTheyMayBeWide) {
  const auto scan = scan_from(corridor_with(person_at({1.1, 0.6})), here, 0, 91, 1.5707963);
  EXPECT_EQ(without_narrow_things(scan), scan);
}

TEST(NarrowThings, BeamsThatDoNotComeBackGoOnBehindThem) {
  LaserScan scan;
  scan.first_angle = -0.5;
  scan.angle_step = 0.02;
  scan.max_range = 10;
  scan.ranges.assign(51, 0);
  EXPECT_EQ(without_narrow_things(scan), scan);
  std::fill_n(scan.ranges.begin() + 20, 8, 2.f);
  EXPECT_TRUE(
    std::ranges::all_of(without_narrow_things(scan).ranges, [](auto x) { return x == 0; }));
}

} // namespace

} // namespace castor::mapping::test
