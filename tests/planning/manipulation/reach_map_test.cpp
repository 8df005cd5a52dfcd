#include "castor/planning/manipulation/reach_map.hpp"

#include "castor/mapping/geometry/eigen_bridge.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/perception/spatial/reach.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <variant>

namespace castor::manipulation {

namespace {

using std::numbers::pi;

constexpr const char* stands_at = "0 -0.37 heading 90";

spatial::ReachableTable reach_of(const ArmModel& arm) {
  return reach_map(arm, InverseKinematics(arm), arm_placement(stands_at));
}

/// About the x axis.
geometry::Rotation turned(double angle) {
  return geometry::to_rotation(
    Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX())));
}

/// Whether there is a plan to take a cylinder from a place of the table that is otherwise empty.
bool can_take(const ManipulationPlanner& planner, const spatial::GroundPoint& from, double height) {
  const auto middle = geometry::transform(geometry::inverse(arm_placement(stands_at), arm_frame),
                                          Point3{from.x, from.y, height / 2});
  const Scene scene{
    {table_top(4, 4), thing("the can", cylinder(0.05, height), middle.x, middle.y, middle.z)}, {}};
  return std::holds_alternative<ManipulationPlan>(
    planner.pick(scene, "the can", planner.arm().home));
}

} // namespace

TEST(ReachMap, TellsWhatThePlannerCanTake) {
  const auto arm = katana();
  const auto reach = reach_of(arm);
  const ManipulationPlanner planner(arm);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-0.29, 0.29);
  std::uniform_real_distribution<double> y(-0.25, 0.25);
  std::uniform_real_distribution<double> heights(0.03, 0.09);
  int reached = 0;
  int unreached = 0;
  int missed = 0;
  for (int i = 0; i < 100; ++i) {
    const spatial::GroundPoint from{x(random), y(random)};
    const double height = heights(random);
    const bool is_reached = spatial::ways_at(reach, from, height) != 0;
    const bool is_possible = can_take(planner, from, height);
    EXPECT_TRUE(is_possible || !is_reached) << from.x << ' ' << from.y << ' ' << height;
    reached += is_reached;
    unreached += !is_reached;
    missed += is_possible && !is_reached;
  }
  EXPECT_GT(reached, 20);
  EXPECT_GT(unreached, 10);
  // Within a step of the border of what is reached.
  EXPECT_LT(missed, 15);
}

TEST(ReachMap, WhatIsHighIsGraspedFromTheSideOnly) {
  const auto arm = katana();
  const auto reach = reach_of(arm);
  // Far away the hand cannot point down any more.
  constexpr std::uint32_t from_above = 1;
  const auto& tilts = GraspOptions{}.tilts;
  ASSERT_EQ(tilts.front(), pi);
  EXPECT_NE(spatial::ways_at(reach, {0, -0.14}, 0.05) & from_above, 0U);
  const auto far = spatial::ways_at(reach, {0, 0.08}, 0.08);
  EXPECT_NE(far, 0U);
  EXPECT_EQ(far & from_above, 0U);
}

TEST(ReachMap, KnowsHowAThingIsHeld) {
  const GraspOptions options;
  // The hand points down, and forwards.
  EXPECT_EQ(ways_held({{}, turned(pi), "tool"}, options), 1U);
  EXPECT_EQ(ways_held({{}, turned(pi / 2), "tool"}, options),
            std::uint32_t{1} << (options.tilts.size() - 1));
  EXPECT_EQ(ways_held({{}, {}, "tool"}, options), ~0U);
}

} // namespace castor::manipulation
