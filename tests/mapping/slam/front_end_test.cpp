#include "castor/mapping/slam/front_end.hpp"

#include "castor/tests/mapping/slam/simulated_room.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace castor::mapping::test {

namespace {

constexpr std::int64_t period = 100000;

class FrontEndTest : public ::testing::Test {
protected:
  FrontEndStep see(std::size_t i) {
    return front_end.add(
      with_noise(scan_from(walls, path[i], static_cast<std::int64_t>(i) * period), 0.01, random),
      odometry[i]);
  }

  // How far the pose of step i is from the truth.
  double error_of(const FrontEndStep& step, std::size_t i) const {
    return distance(in_map(path, i), step.local_pose);
  }

  std::vector<Wall> walls = furnished_room();
  std::vector<Pose2> path = path_around(1);
  std::vector<Pose2> odometry = odometry_of(path, 0.05);
  std::mt19937 random{3};
  FrontEnd front_end;
};

TEST_F(FrontEndTest, FollowsTheRobotBetterThanItsWheels) {
  double worst = 0;
  double worst_of_wheels = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    auto step = see(i);
    EXPECT_EQ(step.state, LocalisationState::tracking);
    worst = std::max(worst, error_of(step, i));
    worst_of_wheels = std::max(
      worst_of_wheels, distance(between(path[0], path[i]), between(odometry[0], odometry[i])));
  }
  EXPECT_GT(worst_of_wheels, 1);
  EXPECT_LT(worst, 0.1);
}

TEST_F(FrontEndTest, KeyframesAreNumberedAndFollowFromEachOther) {
  std::int64_t next = 0;
  Pose2 by_constraints = odometry[0];
  for (std::size_t i = 0; i < path.size(); ++i) {
    auto step = see(i);
    EXPECT_EQ(step.new_keyframe.has_value(), step.constraint.has_value() || i == 0);
    if (step.new_keyframe) {
      EXPECT_EQ(step.new_keyframe->number, next);
      EXPECT_EQ(step.new_keyframe->odometry, odometry[i]);
      EXPECT_EQ(step.new_keyframe->time, static_cast<std::int64_t>(i) * period);
    }
    if (step.constraint) {
      EXPECT_EQ(step.constraint->from, next - 1);
      EXPECT_EQ(step.constraint->to, next);
      EXPECT_EQ(step.constraint->kind, ConstraintKind::motion);
      EXPECT_GT(step.constraint->covariance.xx, 0);
      by_constraints = compose(by_constraints, step.constraint->pose);
      EXPECT_LT(distance(by_constraints, step.new_keyframe->local_pose), 1e-6);
    }
    next += step.new_keyframe ? 1 : 0;
    EXPECT_EQ(step.keyframe, next - 1);
    EXPECT_LT(std::hypot(step.on_keyframe.x, step.on_keyframe.y), 0.3);
  }
  // 23.4 m of way and a turn, one each 15 cm or 7 degrees.
  EXPECT_GT(next, 130);
  EXPECT_LT(next, 260);
}

TEST_F(FrontEndTest, ARobotThatStandsMakesOneKeyframe) {
  for (std::size_t i = 0; i < 30; ++i) {
    path[i] = path[0];
    odometry[i] = odometry[0];
    EXPECT_EQ(see(i).new_keyframe.has_value(), i == 0);
  }
}

TEST_F(FrontEndTest, OdometryThatComesLate) {
  // The wheels say nothing for three scans, and then all at once.
  auto late = odometry;
  for (std::size_t i = 0; i < path.size(); ++i)
    late[i] = odometry[i - i % 4];
  odometry = late;
  double worst = 0;
  for (std::size_t i = 0; i < path.size(); ++i)
    worst = std::max(worst, error_of(see(i), i));
  EXPECT_LT(worst, 0.15);
}

/// Something as wide as a trolley goes along a wall of a corridor in which the robot stands: all
/// that tells where along it the robot is. Returns how far the robot seems to go.
double taken_along(const FrontEndOptions& options) {
  FrontEnd front_end(options);
  std::mt19937 random{3};
  double result = 0;
  for (int i = 0; i < 60; ++i) {
    // It comes at a walk after a second, and is never seen through.
    const double front = 3 - 0.08 * std::max(0, i - 10);
    const std::vector<Wall> walls{{{-30, 1.2}, {30, 1.2}},
                                  {{-30, -1.2}, {30, -1.2}},
                                  {{front, -1.2}, {front, -0.1}},
                                  {{front, -0.1}, {front + 1.2, -0.1}},
                                  {{front + 1.2, -0.1}, {front + 1.2, -1.2}}};
    const auto step =
      front_end.add(with_noise(scan_from(walls, {}, i * period), 0.01, random), Pose2{});
    result = std::max(result, std::hypot(step.local_pose.x, step.local_pose.y));
  }
  return result;
}

TEST(FrontEndInACorridor, ARobotThatStandsIsNotTakenAlong) {
  EXPECT_LT(taken_along({}), 0.1);
  FrontEndOptions points_only;
  points_only.few_points = 0;
  EXPECT_GT(taken_along(points_only), 0.3) << "this shows nothing";
}

// A corridor that narrows by 4 cm with each metre, and then a laser that measures 3 cm too little
// on both sides, where scans were missing: it fits best 1.5 m further on, where closest points
// move it.
TEST(FrontEndInACorridor, ASearchDoesNotLeaveItsWindow) {
  const auto narrowing = [](double half_width) {
    constexpr double narrower = 0.02;
    return std::vector<Wall>{{{-5, half_width + 5 * narrower}, {30, half_width - 30 * narrower}},
                             {{-5, -half_width - 5 * narrower}, {30, -half_width + 30 * narrower}}};
  };
  FrontEnd front_end;
  for (int i = 0; i < 5; ++i)
    front_end.add(scan_from(narrowing(1.2), {}, i * period), {});
  const Pose2 here{0.05, 0, 0};
  const auto step = front_end.add(scan_from(narrowing(1.17), here, 4 * period + 2'000'000), here);
  EXPECT_LT(distance(step.local_pose, here), 0.6);
}

TEST_F(FrontEndTest, ABlindLaserLeavesTheWheels) {
  for (std::size_t i = 0; i < 40; ++i)
    see(i);
  walls.clear();
  auto step = see(40);
  EXPECT_EQ(step.state, LocalisationState::dead_reckoning);
  EXPECT_NE(step.reason, "");
  EXPECT_LT(error_of(step, 40), 0.1);
  for (std::size_t i = 41; i < 48; ++i)
    if (auto next = see(i); next.constraint) {
      EXPECT_EQ(next.constraint->kind, ConstraintKind::wheels);
      EXPECT_GT(next.constraint->covariance.xx, 4e-4);
    }
  // It sees again what it knew before.
  walls = furnished_room();
  step = see(48);
  EXPECT_EQ(step.state, LocalisationState::tracking);
  EXPECT_LT(error_of(step, 48), 0.1);
}

TEST_F(FrontEndTest, OdometryThatStartsAnewIsNoMovement) {
  for (std::size_t i = 0; i < 40; ++i)
    see(i);
  for (auto& x : odometry)
    x = compose(Pose2{100, 50, 2}, x);
  EXPECT_LT(error_of(see(40), 40), 0.1);
  EXPECT_LT(error_of(see(41), 41), 0.1);
}

TEST_F(FrontEndTest, ANewOneGoesOnFromKeyframes) {
  std::vector<Keyframe> keyframes;
  for (std::size_t i = 0; i < 100; ++i)
    if (auto step = see(i); step.new_keyframe)
      keyframes.push_back(*step.new_keyframe);
  front_end = FrontEnd{};
  front_end.resume({keyframes.end() - 15, keyframes.end()});
  // Twenty scans are missing.
  auto step = see(120);
  EXPECT_EQ(step.state, LocalisationState::tracking);
  EXPECT_LT(error_of(step, 120), 0.1);
  ASSERT_TRUE(step.new_keyframe);
  EXPECT_EQ(step.new_keyframe->number, keyframes.back().number + 1);
  ASSERT_TRUE(step.constraint);
  EXPECT_LT(error_of(see(121), 121), 0.1);
}

TEST_F(FrontEndTest, ANewOneWithoutOdometryOfTheGapFindsItsPlaceNearby) {
  std::vector<Keyframe> keyframes;
  for (std::size_t i = 0; i < 60; ++i)
    if (auto step = see(i); step.new_keyframe)
      keyframes.push_back(*step.new_keyframe);
  front_end = FrontEnd{};
  front_end.resume({keyframes.end() - 15, keyframes.end()});
  for (auto& x : odometry)
    x = compose(Pose2{-20, 7, 1}, x);
  EXPECT_LT(error_of(see(66), 66), 0.1);
}

} // namespace

} // namespace castor::mapping::test
