#include "castor/planning/manipulation/motion_planner.hpp"

#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace castor::manipulation {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// To the right and to the left, with the hand 0.43 m from the base and 6 cm above the table.
const Configuration right{-1.2, 0.6, 1.3, 0.6, 0};
const Configuration left{1.2, 0.6, 1.3, 0.6, 0};

/// A wall before the arm, 0.30 m high.
NamedSolid wall() {
  return thing("the wall", box(0.5, 0.05, 0.3), 0.35, 0, 0.15);
}

} // namespace

TEST(BlockedWay, NamesTheOneThingThatHasToGo) {
  const auto failure = blocked_way({"the cube", "the box"}, "the ball", [](const auto& without) {
    return without == std::vector<std::string>{"the cube"};
  });
  EXPECT_EQ(failure.text, "the cube blocks every way to the ball");
  EXPECT_THAT(failure.obstacles, ElementsAre("the cube"));
  EXPECT_EQ(failure.kind, MotionFailureKind::no_way);
}

TEST(BlockedWay, NamesAllThingsOfWhichEachWouldHelp) {
  const auto failure =
    blocked_way({"the cube", "the box", "the can"}, "the ball",
                [](const auto& without) { return std::ranges::count(without, "the can") == 0; });
  EXPECT_EQ(failure.text,
            "there is no way to the ball: it would help to take away the cube or the box");
}

TEST(BlockedWay, NamesNoMoreThanBlockTheWayTogether) {
  const auto failure =
    blocked_way({"the cube", "the box", "the can"}, "the ball", [](const auto& without) {
      return std::ranges::count(without, "the cube") > 0 &&
             std::ranges::count(without, "the can") > 0;
    });
  EXPECT_EQ(failure.text, "the cube and the can together block every way to the ball");
  EXPECT_THAT(failure.obstacles, ElementsAre("the cube", "the can"));
}

TEST(BlockedWay, SaysSoIfNothingIsInTheWay) {
  const auto failure = blocked_way({"the cube"}, "the ball", [](const auto&) { return false; });
  EXPECT_TRUE(failure.obstacles.empty());
  EXPECT_THAT(failure.text, HasSubstr("even without"));
}

TEST(MotionPlanner, GoesOverAWall) {
  const auto arm = katana();
  const Scene scene{{table_top(2, 2), wall()}, {}};
  for (auto algorithm : {"rrt_connect", "rrt_star", "bit_star"}) {
    SCOPED_TRACE(algorithm);
    MotionPlannerOptions options;
    options.algorithm = planning_algorithm(algorithm);
    options.time_limit = options.algorithm == PlanningAlgorithm::rrt_connect ? 10 : 4;
    const auto result = plan_motion(arm, scene, right, {left}, "the left", options);
    ASSERT_TRUE(std::holds_alternative<JointPath>(result)) << std::get<MotionFailure>(result).text;
    const auto& path = std::get<JointPath>(result);
    EXPECT_EQ(path.waypoints.front(), right);
    EXPECT_LT(distance(path.waypoints.back(), left), 1e-12);
    EXPECT_GT(path.waypoints.size(), 2u);
    EXPECT_LE(path.length, path.found_length + 1e-9);
    CollisionChecker checker(arm, scene);
    for (std::size_t i = 1; i < path.waypoints.size(); ++i)
      EXPECT_TRUE(checker.is_free_between(path.waypoints[i - 1], path.waypoints[i]));
  }
}

TEST(MotionPlanner, GoesOverAWallWithAJointThatStandsStill) {
  constexpr std::size_t roll = 4;
  const auto arm = with_still_joint(katana(), roll, 0.7);
  const auto from = kept_within_limits(arm, right);
  const auto to = kept_within_limits(arm, left);
  const auto result = plan_motion(arm, {{table_top(2, 2), wall()}, {}}, from, {to}, "the left", {});
  ASSERT_TRUE(std::holds_alternative<JointPath>(result)) << std::get<MotionFailure>(result).text;
  for (const auto& x : std::get<JointPath>(result).waypoints)
    EXPECT_NEAR(x[roll], 0.7, 1e-9);
}

TEST(MotionPlanner, GoesStraightIfNothingIsInTheWay) {
  const auto result = plan_motion(katana(), {{table_top(2, 2)}, {}}, right, {left}, "the left");
  ASSERT_TRUE(std::holds_alternative<JointPath>(result));
  EXPECT_EQ(std::get<JointPath>(result).waypoints.size(), 2u);
}

TEST(MotionPlanner, TheSameSeedGivesTheSameMotion) {
  const Scene scene{{table_top(2, 2), wall()}, {}};
  MotionPlannerOptions options;
  options.time_limit = 10;
  // Simplification ends when it is done, not when its time is over.
  options.simplification_time_limit = 10;
  options.seed = 7;
  const auto once = plan_motion(katana(), scene, right, {left}, "the left", options);
  const auto again = plan_motion(katana(), scene, right, {left}, "the left", options);
  ASSERT_TRUE(std::holds_alternative<JointPath>(once));
  EXPECT_EQ(std::get<JointPath>(once).waypoints, std::get<JointPath>(again).waypoints);
}

TEST(MotionPlanner, NamesWhatBlocksEveryWay) {
  // The arm could turn around its turret if it stood upright, which the lid prevents. Without the
  // pillar, straight motion is possible, which needs no luck within the time limit.
  MotionPlannerOptions options;
  options.time_limit = 1;
  options.explanation_time_limit = 0.5;
  const Scene scene{{thing("the pillar", box(0.6, 0.04, 4), 0.4, 0, 0),
                     thing("the cupboard", box(0.6, 0.04, 4), -0.4, 0, 0),
                     thing("the lid", box(2, 2, 0.04), 0, 0, 0.6),
                     thing("the mug", cylinder(0.08, 0.1), -0.4, 0.5, 0.05)},
                    {}};
  const auto result = plan_motion(katana(), scene, right, {left}, "the ball", options);
  ASSERT_TRUE(std::holds_alternative<MotionFailure>(result));
  const auto& failure = std::get<MotionFailure>(result);
  EXPECT_EQ(failure.kind, MotionFailureKind::no_way);
  EXPECT_THAT(failure.obstacles, ::testing::Contains("the pillar"));
  EXPECT_THAT(failure.obstacles, ::testing::Not(::testing::Contains("the mug")));
  EXPECT_THAT(failure.text, HasSubstr("the pillar"));
}

TEST(MotionPlanner, NamesWhatIsInTheWayAtTheGoal) {
  const auto at = tool_pose(katana(), left).position;
  const Scene scene{{table_top(2, 2), thing("the cube", box(0.1, 0.1, 0.1), at.x, at.y, at.z)}, {}};
  const auto result = plan_motion(katana(), scene, right, {left}, "the ball");
  ASSERT_TRUE(std::holds_alternative<MotionFailure>(result));
  EXPECT_EQ(std::get<MotionFailure>(result).kind, MotionFailureKind::goal_blocked);
  EXPECT_EQ(std::get<MotionFailure>(result).text, "the cube is in the arm's way at the ball");
}

TEST(MotionPlanner, NamesWhatTheArmTouchesAlready) {
  const auto at = tool_pose(katana(), right).position;
  const Scene scene{{thing("the cube", box(0.1, 0.1, 0.1), at.x, at.y, at.z)}, {}};
  const auto result = plan_motion(katana(), scene, right, {left}, "the ball");
  ASSERT_TRUE(std::holds_alternative<MotionFailure>(result));
  EXPECT_EQ(std::get<MotionFailure>(result).kind, MotionFailureKind::start_blocked);
  EXPECT_THAT(std::get<MotionFailure>(result).text, HasSubstr("touches the cube already"));
}

TEST(MotionPlanner, RefusesConfigurationsBeyondTheLimits) {
  EXPECT_THROW(plan_motion(katana(), {}, {9, 0, 0, 0, 0}, {left}, "it"), std::invalid_argument);
  EXPECT_THROW(plan_motion(katana(), {}, right, {}, "it"), std::invalid_argument);
  EXPECT_THROW(planning_algorithm("a_star"), std::invalid_argument);
}

} // namespace castor::manipulation
