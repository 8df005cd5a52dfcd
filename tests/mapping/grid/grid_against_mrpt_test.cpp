// Castor's occupancy grid beside MRPT's, on the same scans.

#include "castor/mapping/grid/occupancy_grid.hpp"

#include "castor/tests/mapping/grid/box_room.hpp"

#include <gtest/gtest.h>

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <chrono>
#include <numbers>
#include <random>

namespace castor::mapping::test {

namespace {

mrpt::obs::CObservation2DRangeScan mrpt_scan(const LaserScan& scan) {
  mrpt::obs::CObservation2DRangeScan result;
  result.rightToLeft = true;
  result.aperture =
    static_cast<float>(scan.angle_step * static_cast<double>(scan.ranges.size() - 1));
  result.maxRange = static_cast<float>(scan.max_range);
  result.resizeScan(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    result.setScanRange(i, scan.ranges[i]);
    result.setScanRangeValidity(i, scan.ranges[i] > 0);
  }
  return result;
}

TEST(GridAgainstMrpt, TheSameCellsAreFreeAndOccupied) {
  constexpr BoxRoom mrpt_room{-4.02, 6.02, -3.02, 5.02};
  OccupancyGrid ours;
  mrpt::maps::COccupancyGridMap2D theirs{-10, 10, -10, 10, 0.05F};
  theirs.insertionOptions.maxDistanceInsertion = 30;
  std::mt19937 random{1};
  std::uniform_real_distribution<double> place{-2.5, 4.5};
  std::uniform_real_distribution<double> heading{-std::numbers::pi, std::numbers::pi};
  std::normal_distribution<float> noise{0, 0.01F};
  using Clock = std::chrono::steady_clock;
  Clock::duration our_time{};
  Clock::duration their_time{};
  constexpr int scans = 200;
  for (int i = 0; i < scans; ++i) {
    Pose2 robot{place(random), place(random), heading(random)};
    LaserScan scan;
    scan.first_angle = -std::numbers::pi / 2;
    scan.angle_step = std::numbers::pi / 180;
    scan.max_range = 30;
    for (int k = 0; k <= 180; ++k)
      scan.ranges.push_back(
        static_cast<float>(mrpt_room.range({robot.x, robot.y}, robot.heading + scan.first_angle +
                                                                 k * scan.angle_step)) +
        noise(random));
    auto other = mrpt_scan(scan);
    auto start = Clock::now();
    ours.insert(scan, robot);
    our_time += Clock::now() - start;
    start = Clock::now();
    theirs.insertObservation(other, mrpt::poses::CPose3D(robot.x, robot.y, 0, robot.heading, 0, 0));
    their_time += Clock::now() - start;
  }
  int both_known = 0;
  int differ = 0;
  int our_walls = 0;
  int their_walls = 0;
  for (double x = -5; x < 7; x += 0.05)
    for (double y = -4; y < 6; y += 0.05) {
      Point2 point{x + 0.025, y + 0.025};
      auto a = ours.at(cell_of(point, 0.05));
      auto b = theirs.getPos(static_cast<float>(point.x), static_cast<float>(point.y));
      auto occupied = a != unknown_cell && a > 0;
      our_walls += occupied;
      their_walls += b < 0.45F;
      if (a == unknown_cell || a == 0 || (b > 0.45F && b < 0.55F))
        continue;
      ++both_known;
      differ += occupied != (b < 0.5F);
    }
  auto microseconds = [](Clock::duration x) {
    return std::chrono::duration<double, std::micro>(x).count() / scans;
  };
  std::cout << "per scan of 181 beams: Castor " << microseconds(our_time) << " us, MRPT "
            << microseconds(their_time) << " us; walls " << our_walls << " and " << their_walls
            << " cells; " << differ << " of " << both_known << " cells differ\n";
  EXPECT_GT(both_known, 30000);
  EXPECT_LT(differ, both_known / 100);
}

} // namespace

} // namespace castor::mapping::test
