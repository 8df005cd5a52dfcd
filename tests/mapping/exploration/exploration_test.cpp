// Decisions of an exploring robot, without a robot.

#include "castor/mapping/exploration/exploration_planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace castor::mapping::test {

namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double side = 0.1;

/// '.' is free, '#' occupied, ' ' unknown; cells of 0.1 m, the last row at the bottom.
CellMap map_of(const std::vector<std::string>& picture) {
  CellMap result;
  result.cell_size = side;
  result.rows = static_cast<int>(picture.size());
  result.columns = static_cast<int>(picture.front().size());
  for (auto row = picture.rbegin(); row != picture.rend(); ++row)
    for (char x : *row)
      result.cells.push_back(x == '.' ? 10 : x == '#' ? 90 : -1);
  return result;
}

/// A closed room of free cells.
std::vector<std::string> room(std::size_t columns, std::size_t rows) {
  std::vector<std::string> result(rows, "#" + std::string(columns - 2, '.') + "#");
  result.front() = result.back() = std::string(columns, '#');
  return result;
}

std::vector<Frontier> frontiers_in(const CellMap& map, const Pose2& robot) {
  const FreeFloor floor(map, robot, {});
  return find_frontiers(map, floor);
}

} // namespace

TEST(FreeFloor, KeepsTheClearance) {
  const auto map = map_of(room(21, 21));
  const FreeFloor floor(map, {1, 1, 0}, {.clearance = 0.3});
  EXPECT_NEAR(floor.way_to({15, 10}), 0.5, 1e-6);
  EXPECT_NEAR(floor.way_to({14, 14}), 4 * side * std::sqrt(2.0), 1e-6);
  // Three cells from the wall's first one.
  EXPECT_TRUE(std::isfinite(floor.way_to({3, 10})));
  EXPECT_FALSE(std::isfinite(floor.way_to({2, 10})));
  EXPECT_TRUE(floor.is_connected({2, 10}));
  EXPECT_FALSE(std::isfinite(floor.way_to({-1, 10})));
  EXPECT_NEAR(floor.area(), 19 * 19 * side * side, 1e-9);
}

TEST(FreeFloor, SeesUpToWhatIsOccupied) {
  auto picture = room(21, 21);
  picture[10][10] = '#';
  const auto map = map_of(picture);
  const FreeFloor floor(map, {0.5, 1, 0}, {});
  EXPECT_TRUE(floor.sees({5, 10}, {9, 10}));
  EXPECT_FALSE(floor.sees({5, 10}, {15, 10}));
  EXPECT_FALSE(floor.sees({5, 10}, {10, 10}));
}

TEST(Frontiers, AreNoneInAClosedRoom) {
  EXPECT_THAT(frontiers_in(map_of(room(21, 21)), {1, 1, 0}), IsEmpty());
}

TEST(Frontiers, AreNoneInAnEmptyMap) {
  EXPECT_THAT(frontiers_in({}, {1, 1, 0}), IsEmpty());
}

TEST(Frontiers, AreWhereAnOpenDoorIs) {
  auto picture = room(21, 31);
  for (int i = 6; i < 16; ++i)
    picture[static_cast<std::size_t>(i)][20] = '.';
  const auto found = frontiers_in(map_of(picture), {0.8, 1.5, 0});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].size, 1.0, 1e-9);
  EXPECT_TRUE(found[0].is_reachable) << found[0].reason;
  EXPECT_NEAR(found[0].middle.x, 2.05, 1e-6);
  EXPECT_NEAR(found[0].middle.y, 2.0, 0.1);
  // It faces the door.
  EXPECT_LT(std::abs(found[0].view.heading), 0.8);
  EXPECT_GT(found[0].gain, 5);
}

TEST(Frontiers, BehindANarrowGapAreUnreachableWithTheReason) {
  // A gap of 0.3 m, and the frontier 3 m behind it.
  auto picture = room(61, 21);
  for (std::size_t row = 1; row < 20; ++row)
    picture[row][20] = row >= 9 && row < 12 ? '.' : '#';
  for (std::size_t row = 6; row < 15; ++row)
    picture[row][60] = '.';
  const auto found = frontiers_in(map_of(picture), {1, 1, 0});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_FALSE(found[0].is_reachable);
  EXPECT_THAT(found[0].reason, HasSubstr("too narrow"));
}

TEST(Frontiers, WithoutAFreeWayAreUnreachableWithTheReason) {
  auto picture = room(61, 21);
  for (std::size_t row = 1; row < 20; ++row)
    picture[row][20] = '#';
  for (std::size_t row = 6; row < 15; ++row)
    picture[row][60] = '.';
  const auto found = frontiers_in(map_of(picture), {1, 1, 0});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].reason, HasSubstr("no free way"));
}

TEST(Frontiers, BehindWhichTheRobotDoesNotFitAreNotGoneTo) {
  // A gap of 0.4 m between a cupboard and the wall.
  auto picture = room(41, 41);
  for (std::size_t row = 5; row < 15; ++row)
    for (std::size_t column = 10; column < 31; ++column)
      picture[row][column] = '#';
  for (std::size_t row = 1; row < 5; ++row)
    for (std::size_t column = 13; column < 28; ++column)
      picture[row][column] = ' ';
  const auto narrow = frontiers_in(map_of(picture), {2, 1, 0});
  ASSERT_THAT(narrow, SizeIs(2));
  for (const auto& x : narrow) {
    EXPECT_FALSE(x.is_reachable);
    EXPECT_THAT(x.reason, HasSubstr("too narrow"));
  }
  // The cupboard is moved away from the wall.
  for (std::size_t column = 10; column < 31; ++column)
    for (std::size_t row = 5; row < 9; ++row)
      picture[row][column] = column >= 13 && column < 28 ? ' ' : '.';
  const auto wide = frontiers_in(map_of(picture), {2, 1, 0});
  ASSERT_THAT(wide, SizeIs(2));
  for (const auto& x : wide)
    EXPECT_TRUE(x.is_reachable) << x.reason;
}

TEST(Frontiers, OfANarrowNicheAreNotGoneTo) {
  auto picture = room(41, 41);
  for (std::size_t row = 18; row < 22; ++row)
    picture[row][40] = ' ';
  auto map = map_of(picture);
  map.cell_size = 0.05;
  const auto found = frontiers_in(map, {1, 1, 0});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_FALSE(found[0].is_reachable);
  EXPECT_THAT(found[0].reason, HasSubstr("does not fit"));
}

TEST(FreeFloor, FootprintMayCoverWhatIsUnknown) {
  auto picture = room(41, 21);
  for (std::size_t row = 1; row < 20; ++row)
    for (std::size_t column = 20; column < 40; ++column)
      picture[row][column] = ' ';
  const auto map = map_of(picture);
  const FreeFloor floor(map, {1, 1, 0}, {});
  EXPECT_TRUE(floor.may_cover({30, 10}));
  EXPECT_TRUE(floor.may_cover({38, 10}));
  EXPECT_FALSE(floor.may_cover({40, 10})) << "a wall";
  EXPECT_FALSE(floor.may_cover({39, 1})) << "a corner, for a disc";
  EXPECT_TRUE(floor.may_cover({-1, 10}));
}

TEST(ExplorationPlanner, PrefersTheNearerOfTwoEqualFrontiers) {
  auto picture = room(101, 21);
  for (std::size_t row = 6; row < 15; ++row)
    picture[row][0] = picture[row][100] = '.';
  ExplorationPlanner planner;
  planner.look(map_of(picture), {2.5, 1, 0});
  EXPECT_LT(planner.choose()->middle.x, 1);
  planner.look(map_of(picture), {7.5, 1, 0});
  EXPECT_GT(planner.choose()->middle.x, 9);
}

TEST(ExplorationPlanner, GivesUpWhatDoesNotOpen) {
  auto picture = room(101, 21);
  for (std::size_t row = 6; row < 15; ++row)
    picture[row][0] = picture[row][100] = '.';
  ExplorationPlanner planner;
  planner.look(map_of(picture), {2.5, 1, 0});
  const auto left = *planner.choose();
  EXPECT_TRUE(planner.is_open(left));
  planner.arrived(left);
  const auto right = *planner.choose();
  EXPECT_GT(right.middle.x, 9);
  planner.failed(right, "a cat is in the way");
  planner.arrived(left);
  // Once more.
  EXPECT_GT(planner.choose()->middle.x, 9);
  planner.failed(right, "a cat is in the way");
  EXPECT_FALSE(planner.choose());
  const auto report = planner.report(std::nullopt);
  ASSERT_THAT(report, SizeIs(2));
  for (const auto& x : report) {
    EXPECT_EQ(x.state, FrontierState::given_up);
    EXPECT_THAT(x.reason, HasSubstr(x.x > 5 ? "a cat" : "cannot be seen"));
  }
}

} // namespace castor::mapping::test
