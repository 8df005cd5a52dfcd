#include "castor/mapping/body/laser_model.hpp"

#include "castor/mapping/building/solid_obstacles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace castor::mapping {

namespace {

using std::numbers::pi;

LaserOptions exact_laser() {
  LaserOptions result;
  result.range_noise = 0;
  result.missing = 0;
  result.mount = {};
  return result;
}

/// A wall whose near side is at x = 4.
const SolidObstacles& wall() {
  static const std::vector<Solid> solids{{SolidShape::box, {4.5, 0, 0}, 1, 1000, 0, 1, {}}};
  static const SolidObstacles obstacles(solids);
  return obstacles;
}

} // namespace

TEST(LaserModel, MeasuresAWallExactly) {
  LaserModel laser(exact_laser(), 1);
  auto scan = laser.scan(wall(), {}, {0, 3, 0.2}, 1234);
  EXPECT_EQ(scan.time, 1234);
  ASSERT_EQ(scan.ranges.size(), 181u);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double direction = 0.2 + scan.first_angle + static_cast<double>(i) * scan.angle_step;
    const double expected = std::cos(direction) > 0 ? 4 / std::cos(direction) : 1e9;
    EXPECT_NEAR(scan.ranges[i], expected <= 12 ? expected : 0, 1e-5) << i;
  }
}

TEST(LaserModel, SeesAllAround) {
  auto options = exact_laser();
  options.field_of_view = 360;
  options.beams_per_degree = 2;
  LaserModel laser(options, 1);
  auto scan = laser.scan(wall(), {}, {}, 0);
  ASSERT_EQ(scan.ranges.size(), 720u);
  EXPECT_NEAR(scan.first_angle, -pi, 1e-12);
  EXPECT_NEAR(scan.first_angle + 719 * scan.angle_step, pi - scan.angle_step, 1e-9);
  EXPECT_NEAR(scan.ranges[360], 4, 1e-6);
  EXPECT_EQ(scan.ranges[0], 0);
}

TEST(LaserModel, MeasuresFromWhereItIsMounted) {
  auto options = exact_laser();
  options.mount = {0.5, 0, pi / 2};
  LaserModel laser(options, 1);
  // The robot looks along y, and the scanner's left half along the robot's back and left side.
  auto scan = laser.scan(wall(), {}, {1, 0, -pi / 2}, 0);
  EXPECT_EQ(scan.mount, options.mount);
  EXPECT_NEAR(scan.ranges[90], 3, 1e-6);
}

TEST(LaserModel, SeesPeople) {
  LaserModel laser(exact_laser(), 1);
  const std::vector<Disc> people{{{2, 0}, 0.25}, {{7, 0}, 0.25}};
  auto scan = laser.scan(wall(), people, {}, 0);
  EXPECT_NEAR(scan.ranges[90], 1.75, 1e-6);
  EXPECT_NEAR(scan.ranges[110], 4 / std::cos(20 * pi / 180), 1e-5);
}

TEST(LaserModel, HasNoiseAndMissesReturns) {
  auto options = exact_laser();
  options.range_noise = 0.02;
  options.missing = 0.05;
  LaserModel laser(options, 5);
  double sum = 0;
  double squares = 0;
  int missing = 0;
  int count = 0;
  for (int i = 0; i < 200; ++i) {
    auto scan = laser.scan(wall(), {}, {}, 0);
    // 4 m to 8 m away.
    for (std::size_t beam = 30; beam <= 150; ++beam) {
      const double error =
        scan.ranges[beam] - 4 / std::cos((static_cast<double>(beam) - 90) * pi / 180);
      if (scan.ranges[beam] == 0) {
        ++missing;
        continue;
      }
      ++count;
      sum += error;
      squares += error * error;
    }
  }
  EXPECT_NEAR(sum / count, 0, 0.001) << "unbiased";
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 0.001);
  EXPECT_NEAR(missing / (missing + count + 0.0), 0.05, 0.006);
}

TEST(LaserModel, RefusesImpossibleOptions) {
  auto options = exact_laser();
  options.field_of_view = 400;
  EXPECT_THROW(LaserModel(options, 1), std::invalid_argument);
  options = exact_laser();
  options.max_range = std::nan("");
  EXPECT_THROW(LaserModel(options, 1), std::invalid_argument);
}

} // namespace castor::mapping
