// Fingers that open where something stands beside them.

#include "castor/planning/body/arm_body.hpp"
#include "castor/planning/manipulation/inverse_kinematics.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/tests/planning/body/arm_at_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace castor::manipulation {

namespace {

using testing::HasSubstr;

class OpeningFingers : public testing::Test {
protected:
  /// The tool points down before the arm, as steeply as possible, and its fingers move along y.
  std::vector<Configuration> found() const {
    const InverseKinematics inverse(arm_);
    std::vector<Configuration> result;
    for (double tilt = 180; result.empty() && tilt > 100; tilt -= 7.5) {
      const double half = tilt * degree / 2;
      result = inverse.solve({{0.3, 0, 0.03}, {std::cos(half), 0, std::sin(half), 0}, arm_frame},
                             arm_.home);
    }
    return result;
  }

  void begin(const std::vector<NamedSolid>& things, double opening) {
    const auto above = found();
    ASSERT_FALSE(above.empty());
    body_.emplace(arm_, table_with(things), aside());
    auto state = body_->saved();
    state.positions = above.front();
    state.opening = opening;
    body_->resume(state);
  }

  /// The opening in the end.
  double open_to(double opening) {
    const auto at = body_->configuration();
    MotionStage stage = motion(arm_, at, at, opening);
    finished_ = carry_out(*body_, stage, ++motion_);
    return body_->opening();
  }

  double y_of(const std::string& name) { return body_->world().thing(name).thing.pose.position.y; }

  ArmModel arm_ = katana();
  std::optional<ArmBody> body_;
  std::int64_t motion_ = 0;
  bool finished_ = false;
};

NamedSolid cube_at(const std::string& name, double y) {
  return thing(name, box(0.04, 0.04, 0.04), 0.3, y, 0.02);
}

TEST_F(OpeningFingers, TouchNothingWhereThereIsRoom) {
  begin({cube_at("the cube", 0.09)}, 0.04);
  EXPECT_EQ(open_to(0.1), 0.1);
  EXPECT_TRUE(finished_);
  EXPECT_EQ(y_of("the cube"), 0.09);
  EXPECT_EQ(body_->status().collisions, 0);
}

TEST_F(OpeningFingers, PushWhatStandsBesideThemAndThatIsCounted) {
  for (const double side : {1.0, -1.0}) {
    begin({cube_at("the cube", side * 0.06)}, 0.04);
    EXPECT_EQ(open_to(0.1), 0.1);
    EXPECT_TRUE(finished_);
    // The finger's outer surface is 62 mm from the middle.
    EXPECT_NEAR(y_of("the cube"), side * 0.082, 0.001);
    EXPECT_EQ(body_->status().collisions, 1);
    EXPECT_EQ(body_->status().collision, "the opening gripper pushes the cube");
  }
}

TEST_F(OpeningFingers, StopAtWhatCannotGiveWay) {
  begin({cube_at("the cube", 0.06), cube_at("the wall", 0.11)}, 0.04);
  EXPECT_LT(open_to(0.1), 0.085);
  EXPECT_FALSE(finished_);
  EXPECT_GE(body_->status().collisions, 1);
  EXPECT_THAT(body_->state().fault, HasSubstr("the gripper touches the cube"));
  EXPECT_EQ(y_of("the wall"), 0.11);
  // The arm is not caught there.
  EXPECT_NEAR(open_to(0.05), 0.05, 1e-9);
  EXPECT_TRUE(finished_);
}

TEST_F(OpeningFingers, LeaveWhatIsBetweenThemWhereItIs) {
  begin({cube_at("the cube", 0.004)}, 0.06);
  EXPECT_EQ(open_to(0.1), 0.1);
  EXPECT_EQ(y_of("the cube"), 0.004);
  EXPECT_EQ(body_->status().collisions, 0);
}

TEST_F(OpeningFingers, DoNotGraspBesideThemWhenTheyClose) {
  begin({cube_at("the cube", 0.06)}, 0.04);
  EXPECT_EQ(open_to(0), 0);
  EXPECT_FALSE(body_->state().holds);
  EXPECT_EQ(y_of("the cube"), 0.06);
}

/// What is thinner than the way of a finger is not skipped, either.
TEST_F(OpeningFingers, OpenOnTheWayHomeOnlyAsFarAsThereIsRoom) {
  const ManipulationPlanner planner(arm_);
  for (const double thickness : {0.002, 0.04}) {
    begin({thing("the ball", sphere(0.03), 0.3, 0, 0.015),
           thing("the board", box(0.06, thickness, 0.06), 0.3, 0.045 + thickness / 2, 0.03)},
          0.031);
    const auto scene = body_->world().scene();
    const auto result =
      planner.go(scene, aside(), body_->configuration(), body_->opening(), "goes home", true);
    ASSERT_TRUE(std::holds_alternative<ManipulationPlan>(result)) << thickness;
    const auto& plan = std::get<ManipulationPlan>(result);
    EXPECT_GT(plan.stages.front().opening, 0.031);
    EXPECT_LT(plan.stages.front().opening, 0.07);
    for (const auto& stage : plan.stages)
      EXPECT_TRUE(carry_out(*body_, stage, ++motion_)) << stage.text << body_->state().fault;
    EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
    EXPECT_NEAR(y_of("the board"), 0.045 + thickness / 2, 1e-9);
  }
}

} // namespace

} // namespace castor::manipulation
