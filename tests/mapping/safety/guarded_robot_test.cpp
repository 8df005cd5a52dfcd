// A simulated robot whose driver is reckless, with the rules between them: it runs into nothing.

#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/safety/safety_rules.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <string>
#include <utility>

namespace castor::mapping {

namespace {

const std::string furnished = "wall 0 0 to 8 0 to 8 6 to 0 6 close thickness 0.2\n"
                              "wall 5 0 to 5 6\n"
                              "door d at 5 2.5 width 0.85\n"
                              "furniture table at 2 4 box 1.6 0.8 0.74 legs\n"
                              "furniture plant at 3 1 disc 0.4 1\n"
                              "furniture shelf at 7.7 3 box 1.5 0.4 1.8 turned 90\n"
                              "person ann route 1 2.5 to 7 2.5 speed 0.8\n"
                              "start 2 2.5\n";

struct Drive {
  std::int64_t collisions = 0;
  double driven = 0;
  double least_clearance = 0;
};

struct Robot {
  int field_of_view = 180;
  /// Greatest speed backwards, m/s.
  double backwards = 0;
  std::optional<Footprint> footprint = {};
  double turning_radius = 0;
};

/// Three minutes of random commands, each for up to two seconds.
Drive drive_recklessly(std::uint64_t seed, const Robot& robot) {
  auto read = parse_building(furnished, "furnished.building");
  BodyOptions options;
  options.people = true;
  options.seed = seed;
  options.laser.field_of_view = robot.field_of_view;
  options.footprint = robot.footprint;
  options.drive.turning_radius = robot.turning_radius;
  SimulatedBody body{surroundings_in(read.building, options), options};
  SafetyOptions safety;
  safety.footprint = robot.footprint;
  safety.turning_radius = robot.turning_radius;
  SafetyRules rules{safety};
  std::mt19937_64 random{seed};
  auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>{low, high}(random);
  };
  // The base gets each command two steps later.
  std::deque<Twist2> under_way;
  Twist2 commanded;
  std::int64_t until = 0;
  for (std::int64_t step = 1; step <= 18'000; ++step) {
    body.step();
    const auto now = body.time().count();
    if (step % 2 == 0)
      rules.add(body.odometry(), now);
    if (step % 10 == 0)
      rules.add(body.scan(), now);
    if (now >= until) {
      commanded = {within(-robot.backwards, 0.8), within(-1.6, 1.6)};
      if (within(0, 1) < 0.3)
        commanded.turn = 0;
      until = now + static_cast<std::int64_t>(within(100'000, 2'000'000));
    }
    if (step % 2 == 0)
      under_way.push_back(rules.verdict(commanded, now).velocity);
    if (under_way.size() > 1) {
      body.command(under_way.front());
      under_way.pop_front();
    }
  }
  const auto status = body.status();
  return {status.collisions, status.driven, status.least_clearance};
}

} // namespace

TEST(GuardedRobot, DoesNotCollideForwards) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto x = drive_recklessly(seed, {});
    EXPECT_EQ(x.collisions, 0) << "seed " << seed;
    EXPECT_GT(x.driven, 5) << "seed " << seed;
  }
}

TEST(GuardedRobot, DoesNotCollideBackwardsIfItsLaserLooksAllAround) {
  // With the last two, somebody walks beside it, and comes nearer by and by.
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8, 21, 68}) {
    const auto x = drive_recklessly(seed, {360, 0.8});
    EXPECT_EQ(x.collisions, 0) << "seed " << seed;
    EXPECT_GT(x.driven, 5) << "seed " << seed;
  }
}

TEST(GuardedRobot, DoesNotCollideIfItHasCorners) {
  const Footprint footprint{{{0.45, 0.25}, {-0.45, 0.25}, {-0.45, -0.25}, {0.45, -0.25}}};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto x = drive_recklessly(seed, {360, 0.8, footprint});
    EXPECT_EQ(x.collisions, 0) << "seed " << seed;
    EXPECT_GT(x.driven, 3) << "seed " << seed;
  }
}

TEST(GuardedRobot, DoesNotCollideAsACar) {
  const Footprint footprint{{{0.55, 0.22}, {-0.15, 0.22}, {-0.15, -0.22}, {0.55, -0.22}}};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto x = drive_recklessly(seed, {360, 0.8, footprint, 0.5});
    EXPECT_EQ(x.collisions, 0) << "seed " << seed;
    EXPECT_GT(x.driven, 3) << "seed " << seed;
  }
}

} // namespace castor::mapping
