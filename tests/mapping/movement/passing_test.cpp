#include "castor/mapping/movement/passing.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace castor::mapping {

namespace {

constexpr double fastest = 0.5;

/// A straight way of 8 m, with so much room on both sides.
struct Corridor {
  PathFollower follower{{{0, 0}, {8, 0}}, {}};
  double half_width = 0.8;

  std::optional<Passing> choose(const Pose2& robot, double before,
                                const std::vector<Mover>& movers) const {
    return choose_passing(follower, robot, before, fastest, movers, {},
                          [this](const Point2& x) { return std::abs(x.y) <= half_width; });
  }

  /// Drives as it was chosen.
  Pose2 drive(const Pose2& robot, const Passing& passing, double seconds) {
    auto velocity = velocity_aside(follower, robot, passing.shift, {});
    if (velocity.forward > passing.speed) {
      velocity.turn *= passing.speed / velocity.forward;
      velocity.forward = passing.speed;
    }
    return moved(robot, velocity, seconds);
  }
};

double radii() {
  const MoverOptions options;
  return options.robot_radius + options.mover_radius;
}

} // namespace

TEST(Passing, GoesStraightOnWhereNobodyIs) {
  const auto x = Corridor{}.choose({}, 0.3, {{{20, 0}, {-1, 0}}});
  ASSERT_TRUE(x);
  EXPECT_EQ(x->shift, 0);
  EXPECT_EQ(x->speed, fastest);
}

TEST(Passing, EvadesSomebodyWhoComesTowardsItAndGoesOn) {
  Corridor corridor;
  corridor.half_width = 1;
  Pose2 robot;
  Mover walker{{6, 0}, {-0.8, 0}};
  double shift = 0;
  double nearest = 10;
  constexpr double dt = 0.1;
  for (int i = 0; i < 80; ++i) {
    const auto x = corridor.choose(robot, shift, {walker});
    ASSERT_TRUE(x) << "it stands at " << robot.x << " " << robot.y;
    shift = x->shift;
    robot = corridor.drive(robot, *x, dt);
    walker.place = place_after(walker, dt);
    nearest = std::min(nearest, distance(walker.place, {robot.x, robot.y}));
  }
  EXPECT_GE(nearest, radii());
  EXPECT_GT(robot.x, 2);
}

TEST(Passing, StandsWhereThereIsNoRoomToPass) {
  Corridor corridor;
  corridor.half_width = 0.1;
  EXPECT_FALSE(corridor.choose({}, 0, {{{2, 0}, {-0.8, 0}}}));
}

TEST(Passing, IsSlowerTheNearerSomebodyIsWhomItPasses) {
  Corridor corridor;
  corridor.half_width = 0.05;
  const auto speed_past = [&](double aside) {
    return corridor.choose({}, 0, {{{1, aside}, {0, 0}}}).value_or(Passing{}).speed;
  };
  EXPECT_EQ(speed_past(1.2), fastest);
  EXPECT_LT(speed_past(0.7), speed_past(0.8));
  EXPECT_GT(speed_past(0.62), 0);
  EXPECT_FALSE(corridor.choose({}, 0, {{{0.35, 0.5}, {0, 0}}}));
}

TEST(Passing, KeepsMoreTheFasterItIs) {
  const MoverOptions options;
  EXPECT_EQ(gap_at(0, options), 0);
  EXPECT_DOUBLE_EQ(gap_at(options.near_speed, options), options.passing_gap);
  EXPECT_DOUBLE_EQ(gap_at(options.near_speed + 0.5, options),
                   options.passing_gap + 0.5 * options.passing_time);
}

RC_GTEST_PROP(Passing, NeverComesNearerToAnybodyThanIfItStood, ()) {
  const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) * 0.01; };
  Corridor corridor;
  const Pose2 robot{number(0, 400), number(-40, 40), number(-80, 80)};
  std::vector<Mover> walkers;
  for (int i = 0; i < 3; ++i)
    walkers.push_back(
      {{number(-200, 700), number(-100, 100)}, {number(-120, 120), number(-50, 50)}});
  const auto x = corridor.choose(robot, number(-50, 50), walkers);
  RC_PRE(x.has_value());
  constexpr double dt = 0.1;
  const auto next = corridor.drive(robot, *x, dt);
  for (const auto& walker : walkers) {
    const auto place = place_after(walker, dt);
    RC_ASSERT(distance(place, {next.x, next.y}) >=
              std::min(radii(), distance(place, {robot.x, robot.y})) - 1e-3);
  }
}

} // namespace castor::mapping
