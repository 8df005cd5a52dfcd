#include "castor/planning/body/arm_body.hpp"

#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/tests/planning/body/arm_at_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace castor::manipulation {

namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// The joints of the arm have gone that way between two steps; never faster than they may.
class LimitCheck {
public:
  explicit LimitCheck(const ArmBody& body) : body_(body), before_(body.state()) {}

  void operator()() {
    const auto now = body_.state();
    const auto& joints = body_.arm().joints;
    const auto moving = moving_joints(body_.arm());
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const auto& joint = joints[moving[i]];
      EXPECT_LE(std::abs(now.speeds[i]), joint.speed * 1.0001);
      EXPECT_LE(std::abs(now.speeds[i] - before_.speeds[i]), joint.acceleration * 0.01 * 1.0001);
    }
    before_ = now;
  }

private:
  const ArmBody& body_;
  ArmState before_;
};

TEST(ArmBody, FollowsAMotionWithinTheLimitsOfItsJoints) {
  const auto arm = katana();
  ArmBody body(arm, table_with({}), aside());
  const auto stage = motion(arm, aside(), arm.home);
  LimitCheck check(body);
  double most_lag = 0;
  ASSERT_TRUE(carry_out(body, stage, 1, [&] {
    check();
    const auto wanted = stage.trajectory.at(body.state().motion_time).positions;
    most_lag = std::max(most_lag, distance(wanted, body.configuration()));
  }));
  EXPECT_LT(distance(body.configuration(), arm.home), 1e-3);
  EXPECT_LT(most_lag, 0.02);
  EXPECT_EQ(body.status().collisions, 0);
}

TEST(ArmBody, ComesToRestOnItsMotionWhenCommandsStop) {
  const auto arm = katana();
  // At any time of the motion.
  for (int after = 5; after < 300; after += 20) {
    ArmBody body(arm, table_with({}), aside());
    const auto stage =
      motion(arm, aside(), {-90 * degree, 20 * degree, 60 * degree, 60 * degree, 1.0});
    for (int i = 0; i < after; ++i) {
      auto command = motion_window(stage.trajectory, 1, body.state().motion_time);
      command.opening = 0.1;
      body.command(command, 300ms);
      body.step();
    }
    LimitCheck check(body);
    int steps = 0;
    // The command holds for 30 steps; it stops in 80, and has to catch up a little.
    while (!body.state().rests && steps < 200) {
      body.step();
      check();
      ++steps;
    }
    EXPECT_LE(steps, 30 + 80 + 20) << "after " << after << " steps";
    EXPECT_NEAR(body.status().uncommanded, std::max(0, steps - 30) * 0.01, 0.02);
    const auto wanted = stage.trajectory.at(body.state().motion_time).positions;
    EXPECT_LT(distance(wanted, body.configuration()), 0.01);
  }
}

TEST(ArmBody, StopsBeforeWhatItWouldTouchAndCountsThat) {
  const auto arm = katana();
  // In the way of the turning arm.
  ArmBody body(arm, table_with({thing("the post", box(0.06, 0.06, 0.5), 0.2, 0.12, 0.25)}),
               aside());
  EXPECT_FALSE(carry_out(body, motion(arm, aside(), arm.home), 1));
  EXPECT_EQ(body.status().collisions, 1);
  EXPECT_THAT(body.state().fault, HasSubstr("touches the post"));
  const auto stands = body.configuration();
  for (int i = 0; i < 100; ++i)
    body.step();
  EXPECT_EQ(body.configuration(), stands);
  EXPECT_EQ(body.status().collisions, 1);
  // Another motion may lead away.
  EXPECT_TRUE(carry_out(body, motion(arm, stands, aside()), 2));
  EXPECT_EQ(body.status().collisions, 1);
}

TEST(ArmBody, SaysThatAJointDoesNotFollow) {
  const auto arm = katana();
  ArmBody body(arm, table_with({}), aside());
  body.stick(0);
  EXPECT_FALSE(carry_out(body, motion(arm, aside(), arm.home), 1));
  EXPECT_EQ(body.state().fault, "the joint turret does not follow");
  EXPECT_EQ(body.state().fault_joint, "turret");
  EXPECT_EQ(body.configuration()[0], aside()[0]);
}

TEST(ArmBody, BrakesAllJointsAtOnceWhenOneDoesNotFollow) {
  const auto arm = katana();
  const auto moving = moving_joints(arm);
  for (std::size_t stuck = 0; stuck < moving.size(); ++stuck)
    for (int after = 10; after < 150; after += 10) {
      ArmBody body(arm, table_with({}), aside());
      const auto stage =
        motion(arm, aside(), {-90 * degree, 20 * degree, 60 * degree, 60 * degree, 1.0});
      LimitCheck check(body);
      const auto go_on = [&] {
        auto command = motion_window(stage.trajectory, 1, body.state().motion_time);
        command.opening = 0.1;
        body.command(command, 300ms);
        body.step();
      };
      for (int i = 0; i < after; ++i) {
        go_on();
        check();
      }
      body.stick(stuck);
      for (int i = 0; i < 300 && body.state().fault.empty(); ++i)
        go_on();
      if (body.state().fault.empty())
        // The joint had nothing to do any more.
        continue;
      const auto from = body.state();
      double longest = 0;
      for (std::size_t i = 0; i < moving.size(); ++i)
        longest = std::max(longest, std::abs(from.speeds[i]) / arm.joints[moving[i]].acceleration);
      int steps = 0;
      while (!body.state().rests && steps < 200) {
        body.step();
        ++steps;
      }
      EXPECT_LE(steps, longest / 0.01 + 30) << "joint " << stuck << " after " << after;
      for (std::size_t i = 0; i < moving.size(); ++i) {
        const double speed = from.speeds[i];
        const double way = speed * std::abs(speed) / (2 * arm.joints[moving[i]].acceleration);
        EXPECT_NEAR(body.configuration()[i], from.positions[i] + way, 0.03)
          << "joint " << i << " when " << stuck << " sticks after " << after;
      }
    }
}

TEST(ArmBody, CannotBeginInContact) {
  EXPECT_THROW(ArmBody(katana(), table_with({}), {0, 1.6, 1.0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(ArmBody(katana(), table_with({}), {0, 0, 9, 0, 0}), std::invalid_argument);
}

} // namespace

} // namespace castor::manipulation
