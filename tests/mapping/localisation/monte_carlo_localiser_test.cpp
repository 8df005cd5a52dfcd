#include "castor/mapping/localisation/monte_carlo_localiser.hpp"

#include "castor/benchmarks/localisation/wandering_robot.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/tests/mapping/localisation/room_maps.hpp"

#include <gtest/gtest.h>

#include <mrpt/random.h>

#include <cstdint>
#include <stdexcept>

namespace castor::mapping::test {

namespace {

using localisation_benchmark::WanderingRobot;

constexpr Pose2 begin{1.5, 2, 0.3};

MonteCarloOptions seeded(std::uint64_t seed) {
  MonteCarloOptions result;
  result.filter.seed = seed;
  return result;
}

TEST(MonteCarloLocaliser, TracksARobotFromItsStart) {
  const auto map = furnished_map();
  WanderingRobot robot{map, begin};
  MonteCarloLocaliser localiser{map, robot.truth(), seeded(1)};
  LocalisationStep step;
  for (int i = 0; i < 300; ++i) {
    robot.drive();
    step = localiser.add(robot.scan(), robot.odometry());
    if (i > 20) {
      ASSERT_LT(distance(step.pose, robot.truth()), 0.15) << i;
      ASSERT_EQ(step.state, LocalisationState::tracking) << i << step.reason;
    }
  }
  EXPECT_LT(step.particles, 3000U);
}

TEST(MonteCarloLocaliser, FindsARobotThatMayBeAnywhere) {
  const auto map = furnished_map();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    WanderingRobot robot{map, begin, {.seed = seed}};
    MonteCarloLocaliser localiser{map, {}, seeded(seed)};
    LocalisationStep step;
    for (int i = 0; i < 300 && step.state != LocalisationState::tracking; ++i) {
      robot.drive();
      step = localiser.add(robot.scan(), robot.odometry());
    }
    EXPECT_EQ(step.state, LocalisationState::tracking) << step.reason;
    EXPECT_LT(distance(step.pose, robot.truth()), 0.2) << seed;
  }
}

TEST(MonteCarloLocaliser, NoticesAKidnappingAndFindsTheRobotAgain) {
  const auto map = furnished_map();
  WanderingRobot robot{map, begin};
  MonteCarloLocaliser localiser{map, robot.truth(), seeded(1)};
  LocalisationStep step;
  for (int i = 0; i < 100; ++i) {
    robot.drive();
    step = localiser.add(robot.scan(), robot.odometry());
  }
  ASSERT_EQ(step.state, LocalisationState::tracking) << step.reason;
  robot.kidnap({8.6, 6.6, 2.5});
  int scans = 0;
  for (; scans < 100 && step.state != LocalisationState::lost; ++scans) {
    robot.drive();
    step = localiser.add(robot.scan(), robot.odometry());
  }
  EXPECT_EQ(step.state, LocalisationState::lost);
  EXPECT_LT(scans, 30);
  for (scans = 0; scans < 300 && step.state != LocalisationState::tracking; ++scans) {
    robot.drive();
    step = localiser.add(robot.scan(), robot.odometry());
  }
  EXPECT_EQ(step.state, LocalisationState::tracking) << step.reason;
  EXPECT_LT(distance(step.pose, robot.truth()), 0.2);
}

TEST(MonteCarloLocaliser, SameSeedGivesTheSameAnswer) {
  const auto map = furnished_map();
  WanderingRobot robot{map, begin};
  MonteCarloLocaliser a{map, {}, seeded(7)};
  MonteCarloLocaliser b{map, {}, seeded(7)};
  MonteCarloLocaliser c{map, {}, seeded(8)};
  bool differs = false;
  for (int i = 0; i < 20; ++i) {
    robot.drive();
    auto scan = robot.scan();
    auto of_a = a.add(scan, robot.odometry());
    auto of_c = c.add(scan, robot.odometry());
    auto of_b = b.add(scan, robot.odometry());
    ASSERT_EQ(of_a.pose, of_b.pose);
    ASSERT_EQ(of_a.particles, of_b.particles);
    differs |= of_a.pose != of_c.pose;
  }
  EXPECT_TRUE(differs);
}

TEST(MonteCarloLocaliser, SameSeedGivesTheSameAnswerWhateverElseDraws) {
  const auto map = furnished_map();
  auto pose_with = [&](bool others_draw) {
    WanderingRobot robot{map, begin};
    MonteCarloLocaliser localiser{map, robot.truth(), seeded(7)};
    LocalisationStep step;
    for (int i = 0; i < 10; ++i) {
      if (others_draw)
        mrpt::random::getRandomGenerator().drawGaussian1D_normalized();
      robot.drive();
      step = localiser.add(robot.scan(), robot.odometry());
    }
    return step.pose;
  };
  EXPECT_EQ(pose_with(false), pose_with(true));
}

TEST(MonteCarloLocaliser, ARoomThatLooksAlikeFromBothEndsIsSaidToDo) {
  const auto map = symmetric_map();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    WanderingRobot robot{map, begin, {.seed = seed}};
    MonteCarloLocaliser localiser{map, {}, seeded(seed)};
    for (int i = 0; i < 300; ++i) {
      robot.drive();
      auto step = localiser.add(robot.scan(), robot.odometry());
      ASSERT_NE(step.state, LocalisationState::tracking) << i;
      if (i > 100) {
        ASSERT_GE(step.rivals, 1U) << i;
      }
      if (i == 299) {
        EXPECT_EQ(step.reason, "2 places look alike");
      }
    }
  }
}

TEST(MonteCarloLocaliser, RefusesMapsThatNobodyCanBeFoundIn) {
  CellMap map;
  map.columns = map.rows = 20;
  map.cells.assign(400, 0);
  EXPECT_THROW((MonteCarloLocaliser{map, {}}), std::invalid_argument);
  map.cells.assign(400, 100);
  EXPECT_THROW((MonteCarloLocaliser{map, {}}), std::invalid_argument);
  map.at(3, 3) = 0;
  EXPECT_NO_THROW((MonteCarloLocaliser{map, {}}));
  map.origin.heading = 0.5;
  EXPECT_THROW((MonteCarloLocaliser{map, {}}), std::invalid_argument);
}

} // namespace

} // namespace castor::mapping::test
