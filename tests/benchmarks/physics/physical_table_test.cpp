// Picks of the arm in MuJoCo.

#include "castor/benchmarks/manipulation/physics/physical_table.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/tests/planning/body/arm_at_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace castor::manipulation {

namespace {

using testing::IsEmpty;

Scene table(const std::vector<NamedSolid>& things) {
  Scene result{{table_top(2, 2)}, {}};
  result.things.insert(result.things.end(), things.begin(), things.end());
  return result;
}

ManipulationPlan plan_of(ManipulationResult result) {
  if (const auto* failure = std::get_if<MotionFailure>(&result))
    throw std::runtime_error(failure->text);
  return std::get<ManipulationPlan>(std::move(result));
}

TEST(PhysicalTable, HasTheKinematicsOfTheArm) {
  const auto arm = katana();
  PhysicalTable physics(arm, table({}), aside());
  const auto stage = motion(arm, aside(), arm.home, 0.04);
  physics.carry_out(stage);
  EXPECT_LT(distance(physics.positions(), arm.home), 1e-3);
  EXPECT_LT(physics.most_lag(), 0.01);
  EXPECT_NEAR(physics.opening(), 0.04, 1e-3);
  const auto tool = tool_pose(arm, arm.home);
  const auto seen = physics.pose_of("tool");
  EXPECT_LT(geometry::distance(seen.position, tool.position), 2e-3);
  EXPECT_LT(geometry::angle_between(seen.rotation, tool.rotation), 2e-3);
}

TEST(PhysicalTable, FingersHoldWhatThePlannerLetsThemHold) {
  const auto arm = katana();
  const ManipulationPlanner planner(arm);
  PlaceGoal goal;
  goal.bottom = {0.3, -0.1, 0};
  goal.support = "the table";
  const auto other = thing("the other", box(0.05, 0.05, 0.05), 0.35, 0.15, 0.025);
  for (const auto& it : {thing("it", box(0.05, 0.05, 0.05), 0.3, 0.05, 0.025),
                         thing("it", sphere(0.045), 0.3, 0.05, 0.0225),
                         thing("it", cylinder(0.05, 0.08), 0.3, 0.05, 0.04)}) {
    const auto scene = table({it, other});
    const auto plan = plan_of(planner.pick_and_place(scene, "it", goal, aside()));
    PhysicalTable physics(arm, scene, aside());
    for (const auto& stage : plan.stages) {
      physics.carry_out(stage);
      if (stage.text == "lifts it") {
        EXPECT_GT(physics.pose_of("it").position.z, it.pose.position.z + 0.04)
          << to_string(it.solid.kind);
      }
    }
    EXPECT_LT(geometry::distance(physics.pose_of("it").position, plan.goal->position), 0.012)
      << to_string(it.solid.kind);
    EXPECT_LT(geometry::distance(physics.pose_of("the other").position, other.pose.position),
              0.002);
    EXPECT_THAT(physics.touched(), IsEmpty());
  }
}

TEST(PhysicalTable, ABallThatFingersPressOnAboveItsMiddleSlipsOut) {
  const auto arm = katana();
  const ManipulationPlanner planner(arm);
  const auto ball = [](double height) { return thing("the ball", sphere(0.05), 0.3, 0, height); };
  const auto plan = plan_of(planner.pick(table({ball(0.04)}), "the ball", aside()));
  PhysicalTable physics(arm, table({ball(0.025)}), aside());
  for (const auto& stage : plan.stages)
    physics.carry_out(stage);
  EXPECT_LT(physics.pose_of("the ball").position.z, 0.03);
}

TEST(PhysicalTable, SaysWhatIsNotThere) {
  PhysicalTable physics(katana(), table({}), aside());
  EXPECT_THROW(physics.pose_of("the ball"), std::invalid_argument);
  EXPECT_THROW(PhysicalTable(six_joints(), table({}), Configuration(6, 0)), std::invalid_argument);
}

} // namespace

} // namespace castor::manipulation
