// What a robot may do, by what its laser and its wheels say.

#include "castor/mapping/safety/safety_rules.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace castor::mapping {

namespace {

constexpr std::int64_t millisecond = 1000;
using Reason = SafetyReason;

/// Half a circle ahead, everything that far away.
LaserScan scan_at(std::int64_t time, float range) {
  LaserScan result;
  result.time = time;
  result.first_angle = -std::numbers::pi / 2;
  result.angle_step = std::numbers::pi / 180;
  result.max_range = 12;
  result.ranges.assign(181, range);
  // No two are the same.
  result.ranges[0] += static_cast<float>(time % 997) * 1e-5F;
  return result;
}

/// A wall across the way of the robot.
LaserScan scan_of_wall(std::int64_t time, double ahead) {
  auto result = scan_at(time, 0);
  for (std::size_t i = 0; i < result.ranges.size(); ++i) {
    const double angle = result.first_angle + static_cast<double>(i) * result.angle_step;
    const double range = ahead / std::cos(angle);
    result.ranges[i] = range > 0 && range < result.max_range ? static_cast<float>(range) : 0.F;
  }
  return result;
}

/// A post that far away, from `angle` on to the left, degrees.
LaserScan scan_of_post(std::int64_t time, int angle, float range) {
  auto result = scan_at(time, 5);
  for (int i = 0; i < 6; ++i)
    result.ranges[static_cast<std::size_t>(90 + angle + i)] = range;
  return result;
}

class SafetyRulesTest : public testing::Test {
protected:
  void sense(std::int64_t time, const LaserScan& scan, double speed = 0) {
    rules_.add(Odometry{time, {}, {speed, 0}}, time);
    rules_.add(scan, time);
  }

  SafetyOptions options_;
  SafetyRules rules_{options_};
};

double number_within(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 10'001) / 10'000.0;
}

} // namespace

TEST_F(SafetyRulesTest, PassesOnWhatIsSafe) {
  sense(0, scan_at(0, 5));
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0.3}, 10 * millisecond).velocity, (Twist2{0.5, 0.3}));
  const auto x = rules_.verdict(Twist2{0.5, 0}, 10 * millisecond);
  EXPECT_EQ(x.reason, Reason::none);
  EXPECT_NEAR(x.free_way, 5 - options_.radius, 1e-6);
}

TEST_F(SafetyRulesTest, StandsWithoutCommandAndWithoutSensors) {
  EXPECT_EQ(rules_.verdict(std::nullopt, 0).reason, Reason::no_command);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, 0).reason, Reason::odometry_silent);
  rules_.add(Odometry{}, 0);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, 0).reason, Reason::laser_silent);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, 0).velocity, Twist2{});
}

TEST_F(SafetyRulesTest, StopsWhenALaserIsSilent) {
  sense(0, scan_at(0, 5));
  const auto last = options_.laser_patience.count();
  rules_.add(Odometry{last, {}, {}}, last);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, last).reason, Reason::none);
  const auto x = rules_.verdict(Twist2{0.5, 1}, last + millisecond);
  EXPECT_EQ(x.reason, Reason::laser_silent);
  EXPECT_EQ(x.velocity, Twist2{});
}

TEST_F(SafetyRulesTest, StopsWhenScansAreOldWhenTheyArrive) {
  const auto now = 1000 * millisecond;
  rules_.add(Odometry{now, {}, {}}, now);
  rules_.add(scan_at(now - 300 * millisecond, 5), now);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, now).reason, Reason::laser_silent);
}

TEST_F(SafetyRulesTest, IsNotDeceivedByAClockThatIsAhead) {
  rules_.add(Odometry{5000 * millisecond, {}, {}}, 0);
  rules_.add(scan_at(5000 * millisecond, 5), 0);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, 0).reason, Reason::none);
  EXPECT_NE(rules_.verdict(Twist2{0.5, 0}, 300 * millisecond).reason, Reason::none);
}

TEST_F(SafetyRulesTest, StopsWhenTheWheelsAreSilent) {
  sense(0, scan_at(0, 5));
  const auto now = options_.odometry_patience.count() + millisecond;
  rules_.add(scan_at(now, 5), now);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, now).reason, Reason::odometry_silent);
}

TEST_F(SafetyRulesTest, StopsWhenALaserIsFrozen) {
  auto scan = scan_at(0, 5);
  for (std::int64_t time = 0; time <= 300 * millisecond; time += 100 * millisecond) {
    scan.time = time;
    sense(time, scan);
    EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, time).reason,
              time <= options_.laser_patience.count() ? Reason::none : Reason::laser_frozen);
  }
  sense(400 * millisecond, scan_at(400 * millisecond, 5));
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, 400 * millisecond).reason, Reason::none);
}

TEST(SafetyRulesWithoutNoise, MaySeeTheSameAsLongAsItStands) {
  SafetyOptions options;
  options.laser_has_noise = false;
  SafetyRules rules{options};
  auto scan = scan_at(0, 5);
  double x = 0;
  for (std::int64_t time = 0; time <= 2000 * millisecond; time += 100 * millisecond) {
    // It drives after a second.
    const bool drives = time > 1000 * millisecond;
    x += drives ? 0.05 : 0;
    scan.time = time;
    rules.add(Odometry{time, {x, 0, 0}, {}}, time);
    rules.add(scan, time);
    const bool frozen = time > 1000 * millisecond + options.laser_patience.count();
    EXPECT_EQ(rules.verdict(Twist2{0.5, 0}, time).reason,
              frozen ? Reason::laser_frozen : Reason::none)
      << time;
  }
}

TEST_F(SafetyRulesTest, CanStopBeforeWhatIsAhead) {
  sense(0, scan_of_wall(0, 0.8), 0.5);
  const auto x = rules_.verdict(Twist2{0.8, 0.4}, 0);
  EXPECT_EQ(x.reason, Reason::obstacle);
  EXPECT_GT(x.velocity.forward, 0.1);
  EXPECT_LT(x.velocity.forward, 0.8);
  EXPECT_NEAR(x.velocity.turn / x.velocity.forward, 0.5, 1e-9) << "the same arc";
  const double v = x.velocity.forward;
  EXPECT_LE(v * options_.latency + v * v / (2 * options_.braking),
            0.8 - options_.radius - options_.margin + 0.05);
}

TEST_F(SafetyRulesTest, IsSlowerBeforeWhatComesNearer) {
  sense(0, scan_of_wall(0, 1.2));
  const double still = rules_.verdict(Twist2{0.8, 0}, 0).velocity.forward;
  sense(100 * millisecond, scan_of_wall(100 * millisecond, 1.28));
  sense(200 * millisecond, scan_of_wall(200 * millisecond, 1.2));
  EXPECT_NEAR(rules_.verdict(Twist2{0.8, 0}, 200 * millisecond).velocity.forward, still, 1e-9)
    << "what goes away and comes back is noise";
  sense(300 * millisecond, scan_of_wall(300 * millisecond, 1.36));
  sense(400 * millisecond, scan_of_wall(400 * millisecond, 1.28));
  sense(500 * millisecond, scan_of_wall(500 * millisecond, 1.2));
  EXPECT_LT(rules_.verdict(Twist2{0.8, 0}, 500 * millisecond).velocity.forward, still / 1.5);
}

TEST_F(SafetyRulesTest, MayTurnBeforeAWall) {
  sense(0, scan_of_wall(0, 0.26));
  const auto x = rules_.verdict(Twist2{0.5, 1}, 0);
  EXPECT_EQ(x.reason, Reason::obstacle);
  EXPECT_EQ(x.velocity, (Twist2{0, 1}));
  EXPECT_EQ(rules_.verdict(Twist2{0, -1}, 0).velocity, (Twist2{0, -1}));
}

TEST_F(SafetyRulesTest, DoesNotTurnIntoAPostBeforeItStands) {
  // Straight on it passes the post; by a turn to the left it would touch it.
  sense(0, scan_of_post(0, 47, 0.47F), 0.6);
  EXPECT_EQ(rules_.verdict(Twist2{0, 1.5}, 10 * millisecond).velocity, Twist2{});
  EXPECT_EQ(rules_.verdict(Twist2{0, -1.5}, 10 * millisecond).velocity, (Twist2{0, -1.5}));
}

TEST_F(SafetyRulesTest, TurnsBesideAPostWhereItStands) {
  sense(0, scan_of_post(0, 47, 0.47F));
  EXPECT_EQ(rules_.verdict(Twist2{0, 1.5}, 10 * millisecond).velocity, (Twist2{0, 1.5}));
}

// 0.41 m beside its way.
TEST_F(SafetyRulesTest, KeepsMoreFromWhatMoves) {
  const Twist2 wanted{0.5, 0};
  for (int i = 0; i < 3; ++i)
    sense(i * 100 * millisecond, scan_of_post(i * 100 * millisecond, 55, 0.5F));
  EXPECT_EQ(rules_.verdict(wanted, 210 * millisecond).velocity, wanted) << "it stands";
  SafetyRules rules{options_};
  for (int i = 0; i < 3; ++i) {
    const auto time = i * 100 * millisecond;
    rules.add(Odometry{time, {}, {}}, time);
    rules.add(i < 2 ? scan_at(time, 5) : scan_of_post(time, 55, 0.5F), time);
  }
  const auto x = rules.verdict(wanted, 210 * millisecond);
  EXPECT_EQ(x.reason, Reason::obstacle);
  EXPECT_LT(x.velocity.forward, 0.3);
}

TEST_F(SafetyRulesTest, CreepsWithinTheMargin) {
  sense(0, scan_of_wall(0, 0.29));
  EXPECT_GT(rules_.verdict(Twist2{0.5, 0}, 0).velocity.forward, 0.01);
  EXPECT_LE(rules_.verdict(Twist2{0.5, 0}, 0).velocity.forward, options_.creeping);
}

TEST_F(SafetyRulesTest, KnowsWhereTheWallIsByTheWheels) {
  sense(0, scan_of_wall(0, 1.5));
  rules_.add(Odometry{100 * millisecond, {1.3, 0, 0}, {}}, 100 * millisecond);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, 100 * millisecond).velocity.forward, 0);
}

TEST_F(SafetyRulesTest, RemembersWhatIsNowBesideTheRobot) {
  auto scan = scan_at(0, 5);
  scan.ranges[90] = 0.305F;
  sense(0, scan);
  EXPECT_LE(rules_.verdict(Twist2{0.5, 0}, 0).velocity.forward, options_.creeping);
  // After a turn to the left that is at its right, a little to the back, where the laser does not
  // look; an arc to the left with the robot's back in front would lead there.
  const auto now = 100 * millisecond;
  rules_.add(Odometry{now, {0, 0, 2}, {}}, now);
  rules_.add(scan_at(now, 5), now);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, now).reason, Reason::none);
  const auto back = rules_.verdict(Twist2{-0.1, 0.6}, now);
  EXPECT_EQ(back.reason, Reason::obstacle);
  // It is where the laser looks again, and there is nothing.
  const auto later = 200 * millisecond;
  rules_.add(Odometry{later, {0, 0, 0}, {}}, later);
  rules_.add(scan_at(later, 5), later);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, later).reason, Reason::none);
}

TEST_F(SafetyRulesTest, RemembersWhatItSawAtTheEdgeOfItsFieldOfView) {
  auto scan = scan_at(0, 5);
  // A post to the left, 2 degrees within.
  scan.ranges[178] = 0.28F;
  sense(0, scan);
  EXPECT_LE(rules_.verdict(Twist2{0.5, 0}, 0).velocity.forward, options_.creeping);
  // The wheels have slipped, and do not tell that the post is outside now.
  const auto now = 100 * millisecond;
  sense(now, scan_at(now, 5));
  EXPECT_LE(rules_.verdict(Twist2{0.5, 0}, now).velocity.forward, options_.creeping);
}

TEST_F(SafetyRulesTest, DrivesSlowlyWhereItDoesNotSee) {
  sense(0, scan_at(0, 5));
  const auto x = rules_.verdict(Twist2{-0.5, 0}, 0);
  EXPECT_EQ(x.reason, Reason::unseen_side);
  EXPECT_EQ(x.velocity.forward, -options_.unseen);
  EXPECT_EQ(rules_.verdict(Twist2{-0.05, 0}, 0).reason, Reason::none);
}

TEST(SafetyRulesAllAround, SeesWhatIsBehind) {
  SafetyRules rules{{}};
  auto scan = scan_at(0, 5);
  scan.first_angle = -std::numbers::pi;
  scan.ranges.assign(360, 5);
  scan.ranges[0] = 0.5F;
  rules.add(Odometry{}, 0);
  rules.add(scan, 0);
  const auto x = rules.verdict(Twist2{-0.5, 0.2}, 0);
  EXPECT_EQ(x.reason, Reason::obstacle);
  EXPECT_GT(x.velocity.forward, -0.45);
  EXPECT_EQ(rules.verdict(Twist2{0.5, 0}, 0).reason, Reason::none);
}

TEST_F(SafetyRulesTest, RefusesWhatIsNoNumber) {
  sense(0, scan_at(0, 5));
  EXPECT_EQ(rules_.verdict(Twist2{std::nan(""), 0}, 0).velocity, Twist2{});
}

RC_GTEST_PROP(SafetyRulesProperties, NeverAllowMoreThanWasCommanded, ()) {
  SafetyRules rules{{}};
  auto scan = scan_at(0, 5);
  for (auto& x : scan.ranges)
    x = static_cast<float>(number_within(0, 3));
  const Twist2 velocity{number_within(-0.8, 0.8), number_within(-1.6, 1.6)};
  rules.add(Odometry{0, {}, velocity}, 0);
  rules.add(scan, 0);
  const Twist2 commanded{number_within(-0.8, 0.8), number_within(-1.6, 1.6)};
  const std::int64_t now = *rc::gen::inRange(0, 400) * millisecond;
  const auto x = rules.verdict(commanded, now);
  RC_ASSERT(std::abs(x.velocity.forward) <= std::abs(commanded.forward));
  RC_ASSERT(x.velocity.forward * commanded.forward >= 0);
  RC_ASSERT(std::abs(x.velocity.turn) <= std::abs(commanded.turn));
  RC_ASSERT(x.velocity.turn * commanded.turn >= 0);
  RC_ASSERT(x.reason != Reason::none || x.velocity == commanded);
  if (now > SafetyOptions{}.laser_patience.count())
    RC_ASSERT(x.velocity == Twist2{});
}

/// 1.2 by 0.5 m, whose laser is in its middle.
class SafetyOfCornersTest : public SafetyRulesTest {
protected:
  SafetyOfCornersTest() {
    options_.footprint = Footprint{{{0.6, 0.25}, {-0.6, 0.25}, {-0.6, -0.25}, {0.6, -0.25}}};
    rules_ = SafetyRules{options_};
  }

  /// All around, everything far away but for that.
  LaserScan scan_with(std::int64_t time, const Point2& p) {
    auto result = scan_at(time, 5);
    result.ranges.assign(360, 5);
    result.ranges[0] += static_cast<float>(time % 997) * 1e-5F;
    const double beam = (std::atan2(p.y, p.x) - result.first_angle) / result.angle_step;
    result.ranges[static_cast<std::size_t>(std::lround(beam + 360)) % 360] =
      static_cast<float>(std::hypot(p.x, p.y));
    return result;
  }
};

TEST_F(SafetyOfCornersTest, TurnsOnlyAsFarAsItTouchesNothing) {
  sense(0, scan_with(0, {5, 0}));
  EXPECT_EQ(rules_.verdict(Twist2{0, 1}, 0).velocity, (Twist2{0, 1}));
  // Beside its middle, where its corners will be.
  sense(100 * millisecond, scan_with(100 * millisecond, {0.3, 0.33}));
  const auto x = rules_.verdict(Twist2{0, 1}, 100 * millisecond);
  EXPECT_EQ(x.reason, Reason::obstacle);
  EXPECT_LT(x.velocity.turn, 0.5);
  EXPECT_GT(x.velocity.turn, 0);
  // The other way round, there is more room.
  EXPECT_GT(std::abs(rules_.verdict(Twist2{0, -1}, 100 * millisecond).velocity.turn),
            x.velocity.turn);
  // Along it.
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, 100 * millisecond).reason, Reason::none);
}

// What its tail swings into is behind the laser for as long as a slow turn takes.
TEST_F(SafetyOfCornersTest, RemembersWhatStandsWhereItsTailTurnsTo) {
  auto scan = scan_at(0, 5);
  // Ahead to the left.
  scan.ranges[150] = 0.8F;
  sense(0, scan);
  // It has turned to the right: now that is behind it.
  std::int64_t now = 100 * millisecond;
  const auto turned_verdict = [&] {
    rules_.add(Odometry{now, {0, 0, -2}, {}}, now);
    rules_.add(scan_at(now, 5), now);
    return rules_.verdict(Twist2{-0.1, 0}, now);
  };
  const double free_way = turned_verdict().free_way;
  EXPECT_LT(free_way, 1);
  while (now < 55'000 * millisecond) {
    now += 100 * millisecond;
    ASSERT_NEAR(turned_verdict().free_way, free_way, 0.01) << now;
  }
  now = options_.standing_memory.count() + 200 * millisecond;
  EXPECT_GT(turned_verdict().free_way, 1);
}

TEST_F(SafetyOfCornersTest, StopsBeforeItsFrontTouches) {
  sense(0, scan_with(0, {0.75, 0.2}));
  const auto x = rules_.verdict(Twist2{0.5, 0}, 0);
  EXPECT_EQ(x.reason, Reason::obstacle);
  EXPECT_NEAR(x.free_way, 0.15, 0.01);
  EXPECT_LT(x.velocity.forward, 0.3);
  EXPECT_EQ(rules_.verdict(Twist2{-0.5, 0}, 0).reason, Reason::none);
}

TEST_F(SafetyOfCornersTest, SwingsItsTailSlowlyWhereTheLaserDoesNotLook) {
  sense(0, scan_at(0, 5));
  const auto turning = rules_.verdict(Twist2{0, 1}, 0);
  EXPECT_EQ(turning.reason, Reason::unseen_side);
  EXPECT_NEAR(turning.velocity.turn * 0.6, options_.unseen, 0.01);
  const auto backwards = rules_.verdict(Twist2{-0.5, 0}, 0);
  EXPECT_EQ(backwards.reason, Reason::unseen_side);
  EXPECT_NEAR(backwards.velocity.forward, -options_.unseen, 1e-9);
  EXPECT_EQ(rules_.verdict(Twist2{0.5, 0}, 0).reason, Reason::none);
  const auto arc = rules_.verdict(Twist2{0.5, 0.5}, 0);
  EXPECT_EQ(arc.reason, Reason::unseen_side);
  EXPECT_NEAR(arc.velocity.turn / arc.velocity.forward, 1, 1e-9);
}

} // namespace castor::mapping
