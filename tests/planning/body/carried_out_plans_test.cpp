// Plans of the ManipulationPlanner, carried out by an ArmBody.

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/body/arm_body.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/seen_table.hpp"
#include "castor/planning/manipulation/way_between.hpp"
#include "castor/tests/planning/body/arm_at_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <variant>

namespace castor::manipulation {

namespace {

using testing::HasSubstr;

class CarriedOutPlans : public testing::Test {
protected:
  void set_table(const std::vector<NamedSolid>& things, const ArmBodyOptions& options = {}) {
    body_.emplace(arm_, table_with(things), aside(), options);
  }

  /// The plan's name of a failure, or the plan itself.
  ManipulationPlan expect_plan(ManipulationResult result) {
    if (auto* failure = std::get_if<MotionFailure>(&result)) {
      ADD_FAILURE() << failure->text;
      return {};
    }
    return std::get<ManipulationPlan>(std::move(result));
  }

  bool carry_out_all(const ManipulationPlan& plan) {
    for (const auto& stage : plan.stages)
      if (!carry_out(*body_, stage, ++motion_)) {
        stopped_at_ = stage.text;
        return false;
      }
    return true;
  }

  Point3 place_of(const std::string& name) {
    return body_->world().thing(name).thing.pose.position;
  }

  ArmModel arm_ = katana();
  ManipulationPlanner planner_{arm_};
  std::optional<ArmBody> body_;
  std::int64_t motion_ = 0;
  std::string stopped_at_;
};

PlaceGoal at(double x, double y) {
  PlaceGoal result;
  result.bottom = {x, y, 0};
  result.radius = 0.01;
  result.support = "the table";
  return result;
}

TEST_F(CarriedOutPlans, PutAThingElsewhere) {
  set_table({thing("the cube", box(0.05, 0.05, 0.05), 0.3, 0.1, 0.025),
             thing("the ball", sphere(0.06), 0.35, -0.1, 0.03)});
  const auto plan =
    expect_plan(planner_.pick_and_place(body_->world().scene(), "the ball", at(0.4, 0), aside()));
  EXPECT_TRUE(carry_out_all(plan)) << stopped_at_ << body_->state().fault;
  EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
  EXPECT_NEAR(place_of("the ball").x, 0.4, 0.012);
  EXPECT_NEAR(place_of("the ball").y, 0, 0.012);
  EXPECT_EQ(body_->world().thing("the ball").support, "the table");
}

TEST_F(CarriedOutPlans, StackThings) {
  set_table({thing("the cube", box(0.06, 0.06, 0.06), 0.3, 0.1, 0.03),
             thing("the can", cylinder(0.05, 0.06), 0.35, -0.1, 0.03)});
  PlaceGoal goal;
  goal.bottom = {0.3, 0.1, 0.06};
  goal.support = "the cube";
  const auto plan =
    expect_plan(planner_.pick_and_place(body_->world().scene(), "the can", goal, aside()));
  EXPECT_TRUE(carry_out_all(plan)) << stopped_at_ << body_->state().fault;
  EXPECT_EQ(body_->world().thing("the can").support, "the cube");
  EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
}

TEST_F(CarriedOutPlans, HoldAThingAndPutItDownLater) {
  set_table({thing("the can", cylinder(0.05, 0.09), 0.35, -0.1, 0.045)});
  const auto pick = expect_plan(planner_.pick(body_->world().scene(), "the can", aside()));
  ASSERT_TRUE(carry_out_all(pick)) << stopped_at_;
  EXPECT_GT(place_of("the can").z, 0.1);
  EXPECT_TRUE(body_->state().holds);
  const auto home = expect_plan(
    planner_.go(body_->world().scene(), aside(), body_->configuration(), 0.05, "goes home"));
  ASSERT_TRUE(carry_out_all(home)) << stopped_at_ << body_->state().fault;
  const auto place =
    expect_plan(planner_.place(body_->world().scene(), at(0.3, 0.2), body_->configuration()));
  ASSERT_TRUE(carry_out_all(place)) << stopped_at_ << body_->state().fault;
  EXPECT_NEAR(place_of("the can").x, 0.3, 0.012);
  EXPECT_NEAR(place_of("the can").y, 0.2, 0.012);
  EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
}

TEST_F(CarriedOutPlans, PushWhatCannotBeGrasped) {
  set_table({thing("the plate", box(0.12, 0.12, 0.008), 0.35, 0, 0.004),
             thing("the ball", sphere(0.05), 0.35, 0.18, 0.025)});
  const auto plan = expect_plan(planner_.push(body_->world().scene(), "the plate", {0.1}, aside()));
  EXPECT_TRUE(carry_out_all(plan)) << stopped_at_ << body_->state().fault;
  const auto place = place_of("the plate");
  EXPECT_GE(std::hypot(place.x - 0.35, place.y), 0.095);
  EXPECT_NEAR(place_of("the ball").y, 0.18, 1e-6);
  EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
}

TEST_F(CarriedOutPlans, PushStraightInADirectionAndNoFarther) {
  set_table({thing("the box", box(0.06, 0.06, 0.06), 0.32, 0.02, 0.03)});
  PushGoal goal{0.07};
  goal.along = Point3{0, -1, 0};
  const auto plan = expect_plan(planner_.push(body_->world().scene(), "the box", goal, aside()));
  EXPECT_TRUE(carry_out_all(plan)) << stopped_at_ << body_->state().fault;
  EXPECT_NEAR(place_of("the box").x, 0.32, 0.01);
  EXPECT_NEAR(place_of("the box").y, -0.05, 0.02);
  EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
  goal.may_end_at = [](const Point3& at) { return at.y > 0; };
  EXPECT_TRUE(std::holds_alternative<MotionFailure>(
    planner_.push(body_->world().scene(), "the box", goal, aside())));
}

/// Without turning the hand: round things, and what stands as the hand is turned by chance.
TEST_F(CarriedOutPlans, PutABallElsewhereWithAHandThatDoesNotTurn) {
  constexpr std::size_t roll = 4;
  for (const double degrees : {-100.0, -30.0, 20.0, 75.0}) {
    set_table({thing("the ball", sphere(0.05), 0.3, -0.1, 0.025),
               thing("the cube", box(0.05, 0.05, 0.05), 0.3, 0.15, 0.025)});
    auto start = aside();
    start[roll] = degrees * degree;
    ASSERT_TRUE(carry_out(*body_, motion(arm_, aside(), start), ++motion_));
    body_->stick(roll);
    const ManipulationPlanner planner(with_still_joint(arm_, roll, body_->configuration()[roll]));
    const auto plan = expect_plan(
      planner.pick_and_place(body_->world().scene(), "the ball", at(0.28, 0.02),
                             kept_within_limits(planner.arm(), body_->configuration())));
    EXPECT_TRUE(carry_out_all(plan)) << stopped_at_ << body_->state().fault;
    EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
    EXPECT_NEAR(place_of("the ball").x, 0.28, 0.012);
    EXPECT_NEAR(place_of("the ball").y, 0.02, 0.012);
  }
}

/// What stands near is held from above only, and what is far away cannot be held so.
TEST_F(CarriedOutPlans, PutAThingDownBetweenToHoldItInAnotherWay) {
  set_table({thing("the can", cylinder(0.05, 0.09), 0.2, 0, 0.045)});
  const auto far = at(0.46, 0.05);
  const auto scene = body_->world().scene();
  ASSERT_TRUE(
    std::holds_alternative<MotionFailure>(planner_.pick_and_place(scene, "the can", far, aside())));
  StopsBetween stops{planner_, scene, "the can", free_places({}, 0.05, true), aside()};
  EXPECT_TRUE(stops.are_for(scene, "the can", aside()));
  EXPECT_FALSE(stops.are_for(scene, "the ball", aside()));
  // Stops that are known already serve for another goal.
  EXPECT_FALSE(stops.plan_to(at(0.7, 0.05)));
  const auto first = stops.plan_to(far);
  ASSERT_TRUE(first);
  ASSERT_TRUE(carry_out_all(*first)) << stopped_at_;
  const auto then = expect_plan(
    planner_.pick_and_place(body_->world().scene(), "the can", far, body_->configuration()));
  ASSERT_TRUE(carry_out_all(then)) << stopped_at_;
  EXPECT_NEAR(place_of("the can").x, 0.46, 0.012);
  EXPECT_EQ(body_->world().thing("the can").support, "the table");
  EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
}

/// A cube that stands askew can be grasped from above only, until it is turned at hand.
TEST_F(CarriedOutPlans, TurnAThingAtHandToBringItFarOut) {
  auto cube = thing("the cube", box(0.055, 0.055, 0.055), 0.31, -0.02, 0.0275);
  cube.pose.rotation = geometry::rotation_about_z(20 * degree);
  set_table({cube});
  const auto far = at(0.47, -0.14);
  for (int stops = 0; stops < 4; ++stops) {
    const auto scene = body_->world().scene();
    auto plan = planner_.pick_and_place(scene, "the cube", far, body_->configuration());
    if (auto* found = std::get_if<ManipulationPlan>(&plan)) {
      ASSERT_TRUE(carry_out_all(*found)) << stopped_at_;
      break;
    }
    StopsBetween between{planner_, scene, "the cube", free_places({}, 0.055, true),
                         body_->configuration()};
    const auto stop = between.plan_to(far);
    ASSERT_TRUE(stop);
    ASSERT_TRUE(carry_out_all(*stop)) << stopped_at_;
  }
  EXPECT_NEAR(place_of("the cube").x, 0.47, 0.012);
  EXPECT_NEAR(place_of("the cube").y, -0.14, 0.012);
  EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
}

TEST_F(CarriedOutPlans, EndAtAMissedGrasp) {
  ArmBodyOptions options;
  options.missed_grasp = 1;
  set_table({thing("the ball", sphere(0.06), 0.35, -0.1, 0.03)}, options);
  const auto plan =
    expect_plan(planner_.pick_and_place(body_->world().scene(), "the ball", at(0.4, 0), aside()));
  EXPECT_FALSE(carry_out_all(plan));
  EXPECT_EQ(stopped_at_, "grasps the ball");
  EXPECT_EQ(body_->status().missed, 1);
  EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
}

TEST_F(CarriedOutPlans, EndAtABallThatFingersPressOnAboveItsMiddle) {
  const auto ball = [](double height) { return thing("the ball", sphere(0.05), 0.3, 0, height); };
  // Planned for a ball that lies higher than it does.
  const auto plan =
    expect_plan(planner_.pick({{table_top(2, 2), ball(0.04)}, {}}, "the ball", aside()));
  set_table({ball(0.025)});
  EXPECT_FALSE(carry_out_all(plan));
  EXPECT_EQ(body_->status().missed, 1);
  EXPECT_EQ(body_->status().collisions, 0) << body_->status().collision;
}

TEST_F(CarriedOutPlans, EndWhereAThingIsDropped) {
  ArmBodyOptions options;
  options.dropped = 1;
  options.dropped_within = 1;
  set_table({thing("the ball", sphere(0.06), 0.35, -0.1, 0.03)}, options);
  const auto plan = expect_plan(
    planner_.pick_and_place(body_->world().scene(), "the ball", at(0.3, 0.25), aside()));
  EXPECT_FALSE(carry_out_all(plan));
  EXPECT_EQ(body_->status().dropped, 1);
  EXPECT_EQ(body_->world().thing("the ball").support, "the table");
}

TEST_F(CarriedOutPlans, SayWhatIsInTheWay) {
  set_table({thing("the ball", sphere(0.06), 0.35, -0.1, 0.03),
             thing("the box", box(0.15, 0.15, 0.3), 0.35, 0.1, 0.15)});
  const auto result =
    planner_.pick_and_place(body_->world().scene(), "the ball", at(0.35, 0.1), aside());
  ASSERT_TRUE(std::holds_alternative<MotionFailure>(result));
  EXPECT_THAT(std::get<MotionFailure>(result).text, HasSubstr("the box"));
}

/// Random tables: whatever is planned can be carried out, and nothing is touched.
TEST_F(CarriedOutPlans, NeverTouchAnything) {
  int planned = 0;
  std::string failures;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    const auto any = [&](double low, double high) {
      return std::uniform_real_distribution(low, high)(random);
    };
    std::vector<NamedSolid> things;
    for (std::size_t i = 0; i < 4; ++i) {
      const double size = any(0.04, 0.06);
      const std::vector<Solid> solids{box(size, size, size), sphere(size), cylinder(size, 0.08)};
      const auto& solid = solids[(i + seed) % 3];
      // Each in its own direction from the arm.
      const double angle = any(-0.25, 0.25) + 0.6 * static_cast<double>(i) - 0.9;
      const double away = any(0.24, 0.4);
      things.push_back(thing("thing " + std::to_string(i), solid, away * std::cos(angle),
                             away * std::sin(angle), solid.size.z / 2));
      things.back().pose.rotation = geometry::rotation_about_z(any(0, 1.5));
    }
    set_table(things);
    const auto scene = body_->world().scene();
    const double x = any(0.2, 0.35);
    const double y = any(-0.2, 0.2);
    auto result = planner_.pick_and_place(scene, "thing 0", at(x, y), aside());
    if (auto* failure = std::get_if<MotionFailure>(&result)) {
      failures += failure->text + '\n';
      continue;
    }
    ++planned;
    EXPECT_TRUE(carry_out_all(std::get<ManipulationPlan>(result)))
      << "seed " << seed << ": " << stopped_at_ << ", " << body_->state().fault;
    EXPECT_EQ(body_->status().collisions, 0) << "seed " << seed;
    EXPECT_NEAR(place_of("thing 0").x, x, 0.015) << "seed " << seed;
    EXPECT_NEAR(place_of("thing 0").y, y, 0.015) << "seed " << seed;
  }
  EXPECT_GE(planned, 7) << failures;
}

} // namespace

} // namespace castor::manipulation
