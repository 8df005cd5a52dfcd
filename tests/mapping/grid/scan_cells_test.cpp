// Cells that a scan has evidence about.

#include "castor/mapping/grid/scan_cells.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace castor::mapping::test {

namespace {

LaserScan beam(double angle, double range) {
  LaserScan result;
  result.first_angle = angle;
  result.angle_step = 0.1;
  result.max_range = 20;
  result.ranges = {static_cast<float>(range)};
  return result;
}

constexpr ScanCellsOptions one_metre{.cell_size = 1, .max_range = 10, .free_without_return = 0};

TEST(ScanCells, ABeamEndsInAHitAndPassesTheCellsBefore) {
  auto x = cells_of(beam(0, 3), {0.5, 0.5, 0}, one_metre);
  EXPECT_EQ(x.hits, (std::vector<Cell>{{3, 0}}));
  EXPECT_EQ(x.passes, (std::vector<Cell>{{0, 0}, {1, 0}, {2, 0}}));
}

TEST(ScanCells, CellsBelowTheOriginAreNegative) {
  auto x = cells_of(beam(std::numbers::pi, 1.5), {0.5, -0.5, 0}, one_metre);
  EXPECT_EQ(x.hits, (std::vector<Cell>{{-1, -1}}));
  EXPECT_EQ(x.passes, (std::vector<Cell>{{0, -1}}));
}

TEST(ScanCells, TheMountAndTheHeadingTurnABeam) {
  auto scan = beam(0, 2);
  scan.mount = {1, 0, std::numbers::pi / 2};
  auto x = cells_of(scan, {0.5, 0.5, std::numbers::pi / 2}, one_metre);
  // The scanner is at (0.5, 1.5) and looks to the left.
  EXPECT_EQ(x.hits, (std::vector<Cell>{{-2, 1}}));
}

TEST(ScanCells, ALongBeamIsFreeSpaceOnly) {
  auto x = cells_of(beam(0, 15), {0.5, 0.5, 0}, one_metre);
  EXPECT_TRUE(x.hits.empty());
  EXPECT_EQ(x.passes.size(), 11U);
}

TEST(ScanCells, ABeamWithoutReturnSaysNothingUnlessAskedTo) {
  auto options = one_metre;
  for (auto range : {0.F, -1.F, std::numeric_limits<float>::quiet_NaN(),
                     std::numeric_limits<float>::infinity()}) {
    options.free_without_return = 0;
    auto x = cells_of(beam(0, range), {0.5, 0.5, 0}, options);
    EXPECT_TRUE(x.hits.empty() && x.passes.empty()) << range;
    options.free_without_return = 4;
    x = cells_of(beam(0, range), {0.5, 0.5, 0}, options);
    EXPECT_TRUE(x.hits.empty());
    EXPECT_EQ(x.passes.size(), 5U) << range;
  }
}

TEST(ScanCells, AHitIsNoPassForTheBeamsThatGrazeIt) {
  LaserScan scan;
  scan.angle_step = 0.2;
  scan.ranges = {1.2F, 6};
  auto x = cells_of(scan, {0.5, 0.5, 0}, one_metre);
  EXPECT_EQ(x.hits.size(), 2U);
  EXPECT_EQ(x.hits[0], (Cell{1, 0}));
  EXPECT_EQ(std::ranges::count(x.passes, Cell{1, 0}), 0);
}

RC_GTEST_PROP(ScanCells, ABeamCrossesItsCellsWithoutGaps, ()) {
  auto number = [](int low, int high) { return *rc::gen::inRange(low, high) / 1000.; };
  Pose2 robot{number(-5000, 5000), number(-5000, 5000), number(-3000, 3000)};
  auto scan = beam(number(-3000, 3000), number(10, 9000));
  auto x = cells_of(scan, robot, {.cell_size = 0.25, .max_range = 10});
  RC_ASSERT(x.hits.size() == 1U);
  auto path = x.passes;
  path.push_back(x.hits[0]);
  auto angle = robot.heading + scan.first_angle;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0)
      RC_ASSERT(std::abs(path[i].column - path[i - 1].column) +
                  std::abs(path[i].row - path[i - 1].row) ==
                1);
    // Distance of the centre from the beam's line: within half a diagonal.
    auto centre = centre_of(path[i], 0.25);
    auto off = (centre.x - robot.x) * std::sin(angle) - (centre.y - robot.y) * std::cos(angle);
    RC_ASSERT(std::abs(off) <= 0.25 * std::numbers::sqrt2 / 2 + 1e-6);
  }
}

RC_GTEST_PROP(ScanCells, EachCellIsListedOnce, ()) {
  LaserScan scan;
  scan.first_angle = -1.5;
  scan.angle_step = 0.01;
  for (int i = 0; i < 300; ++i)
    scan.ranges.push_back(static_cast<float>(*rc::gen::inRange(0, 8000)) / 1000);
  auto x = cells_of(scan, {0.1, 0.2, 0.3}, {.cell_size = 0.1, .max_range = 6});
  auto all = x.hits;
  all.insert(all.end(), x.passes.begin(), x.passes.end());
  RC_ASSERT(std::set<Cell>(all.begin(), all.end()).size() == all.size());
}

} // namespace

} // namespace castor::mapping::test
