// An arm that was stopped in the midst of what it did goes home without touching anything.

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/body/arm_body.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/tests/planning/body/arm_at_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace castor::manipulation {

namespace {

class InterruptedPlans : public testing::Test {
protected:
  double any(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

  std::vector<NamedSolid> random_things() {
    std::vector<NamedSolid> result;
    for (std::size_t i = 0; i < 4; ++i) {
      const double size = any(0.04, 0.06);
      const std::vector<Solid> solids{box(size, size, size), sphere(size), cylinder(size, 0.08)};
      const auto& solid = solids[random_() % solids.size()];
      // So near to each other that there is just room for the fingers.
      const double angle = any(-0.1, 0.1) + 0.4 * static_cast<double>(i) - 0.6;
      const double away = any(0.24, 0.38);
      result.push_back(thing("thing " + std::to_string(i), solid, away * std::cos(angle),
                             away * std::sin(angle), solid.size.z / 2));
      result.back().pose.rotation = geometry::rotation_about_z(any(0, 1.5));
    }
    return result;
  }

  /// Carries the plan out up to a step, then nobody commands the arm any more.
  void carry_out_until(const ManipulationPlan& plan, int steps) {
    for (const auto& stage : plan.stages) {
      const auto count = [&] {
        if (--steps == 0)
          throw Interrupted{};
      };
      try {
        if (!carry_out(*body_, stage, ++motion_, count))
          break;
      } catch (const Interrupted&) {
        break;
      }
    }
    for (int i = 0; i < 150; ++i)
      body_->step();
    ASSERT_TRUE(body_->state().rests);
  }

  /// As vision sees it: a little beside.
  Scene seen() {
    auto result = body_->world().scene();
    for (auto& x : result.things)
      if (x.name != "the table") {
        x.pose.position.x += any(-0.002, 0.002);
        x.pose.position.y += any(-0.002, 0.002);
        x.uncertainty = 0.003;
      }
    return result;
  }

  /// What went wrong on the way home; empty if nothing.
  std::string go_home() { return go_home(seen(), false); }

  std::string go_home(const Scene& scene, bool draws_back) {
    const auto before = body_->status().collisions;
    const auto result = planner_.go(scene, aside(), body_->configuration(), body_->opening(),
                                    "goes home", draws_back);
    if (const auto* failure = std::get_if<MotionFailure>(&result))
      return failure->text;
    for (const auto& stage : std::get<ManipulationPlan>(result).stages)
      if (!carry_out(*body_, stage, ++motion_))
        return "while it " + stage.text + ": " + body_->state().fault;
    return body_->status().collisions > before ? body_->status().collision : std::string{};
  }

  struct Interrupted {};

  std::mt19937 random_{1};
  ArmModel arm_ = katana();
  ManipulationPlanner planner_{arm_};
  std::optional<ArmBody> body_;
  std::int64_t motion_ = 0;
};

TEST_F(InterruptedPlans, LeaveAWayHomeAnywhere) {
  int planned = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    random_.seed(seed);
    ArmBodyOptions options;
    options.seed = seed;
    options.missed_grasp = seed % 3 == 0 ? 1 : 0;
    body_.emplace(arm_, table_with(random_things()), aside(), options);
    PlaceGoal goal;
    goal.bottom = {any(0.24, 0.34), any(-0.25, 0.25), 0};
    goal.radius = 0.02;
    goal.support = "the table";
    const auto result = planner_.pick_and_place(seen(), "thing 1", goal, aside());
    if (!std::holds_alternative<ManipulationPlan>(result))
      continue;
    ++planned;
    // It takes some 20 s.
    carry_out_until(std::get<ManipulationPlan>(result), static_cast<int>(any(100, 2000)));
    EXPECT_EQ(go_home(), "") << "seed " << seed;
  }
  EXPECT_GE(planned, 20);
}

/// Where a predecessor has put something, and vision has not seen it there.
TEST_F(InterruptedPlans, LeaveAWayHomeFromWhatNobodyHasSeen) {
  int around = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    random_.seed(seed);
    body_.emplace(arm_, table_with({thing("the ball", sphere(0.05), 0.3, -0.1, 0.025)}), aside());
    const auto unseen = without(body_->world().scene(), {"the ball"});
    PlaceGoal goal;
    goal.bottom = {any(0.26, 0.34), any(0, 0.2), 0};
    goal.support = "the table";
    auto result = planner_.pick_and_place(body_->world().scene(), "the ball", goal, aside());
    ASSERT_TRUE(std::holds_alternative<ManipulationPlan>(result));
    auto plan = std::get<ManipulationPlan>(std::move(result));
    plan.stages.pop_back();
    ASSERT_EQ(plan.stages.back().status, ManipulationStatus::releasing);
    // The fingers do not come as far as they ought to.
    plan.stages.back().opening = any(0.052, 0.06);
    carry_out_until(plan, 100'000);
    ASSERT_EQ(body_->world().thing("the ball").support, "the table");
    around += body_->world().between_fingers(*arm_.gripper, tool_pose(arm_, body_->configuration()),
                                             body_->opening()) != nullptr;
    EXPECT_EQ(go_home(unseen, true), "") << "seed " << seed;
  }
  EXPECT_EQ(around, 12);
}

} // namespace

} // namespace castor::manipulation
