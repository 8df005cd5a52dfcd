#include "castor/planning/continual/continual_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::planning {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

FoundPlan found(PlanReason reason, std::vector<PlannedStep> steps, std::string why = "it did") {
  return {PlanOutcome::changed, std::move(steps), reason, std::move(why), {}, "plan"};
}

const PlannedStep go{"go robby hall"};
const PlannedStep look{"look robby hall", StepKind::sensor};
const PlannedStep promise{"look_a robby", StepKind::assertion};

class ContinualPlanTest : public testing::Test {
protected:
  void observe() { plan.observed({{{{"robby", "robot"}}, facts}}); }

  /// To the first step of a plan.
  void begin(std::vector<PlannedStep> steps) {
    observe();
    plan.planned(found(PlanReason::no_plan_yet, std::move(steps)));
  }

  std::vector<std::string> facts{"(a)", "(b)"};
  ContinualPlan plan{{"(g)", {{"hall", "room"}}, {"(c)"}}, "robby"};
};

TEST_F(ContinualPlanTest, ObservesPlansActsAndObservesAgain) {
  EXPECT_EQ(plan.phase(), PlanPhase::observing);
  observe();
  EXPECT_EQ(plan.phase(), PlanPhase::planning);
  auto request = plan.request();
  EXPECT_EQ(request.goal, "(g)");
  EXPECT_EQ(request.agent, "robby");
  EXPECT_THAT(request.facts, ElementsAre("(a)", "(b)", "(c)"));
  EXPECT_EQ(request.objects.size(), 2U);
  EXPECT_EQ(request.reason, PlanReason::no_plan_yet);
  plan.planned(found(PlanReason::no_plan_yet, {go, look}));
  EXPECT_EQ(plan.phase(), PlanPhase::acting);
  EXPECT_EQ(plan.step(), go);
  plan.succeeded();
  EXPECT_EQ(plan.phase(), PlanPhase::observing);
  observe();
  request = plan.request();
  EXPECT_EQ(request.done, go.action);
  EXPECT_THAT(request.steps, ElementsAre(look));
  EXPECT_EQ(request.reason, PlanReason::none);
  plan.planned({PlanOutcome::kept, {look}, {}, {}, {}, "kept"});
  EXPECT_EQ(plan.step(), look);
  plan.succeeded();
  observe();
  plan.planned({PlanOutcome::achieved, {}, {}, {}, {}, "the goal holds"});
  EXPECT_EQ(plan.phase(), PlanPhase::achieved);
  EXPECT_TRUE(plan.is_over());
  EXPECT_THAT(plan.status().done, ElementsAre(go.action, look.action));
  EXPECT_EQ(plan.status().plans.size(), 1U);
}

TEST_F(ContinualPlanTest, TellsWhatHasChangedInTheState) {
  observe();
  EXPECT_THAT(plan.state().became_true, ElementsAre("(a)", "(b)", "(c)"));
  facts = {"(b)", "(d)", "(d)"};
  observe();
  EXPECT_THAT(plan.state().facts, ElementsAre("(b)", "(c)", "(d)"));
  EXPECT_THAT(plan.state().became_true, ElementsAre("(d)"));
  EXPECT_THAT(plan.state().became_false, ElementsAre("(a)"));
}

TEST_F(ContinualPlanTest, PlansAnewAfterAnActionThatFailed) {
  begin({go});
  plan.failed("the door is shut");
  observe();
  EXPECT_EQ(plan.request().reason, PlanReason::action_failed);
  EXPECT_EQ(plan.request().why, "'go robby hall' failed: the door is shut");
  plan.planned(found(PlanReason::action_failed, {look}));
  EXPECT_EQ(plan.step(), look);
  EXPECT_EQ(plan.request().reason, PlanReason::none);
  EXPECT_EQ(plan.status().in_a_row, 1);
}

TEST_F(ContinualPlanTest, GivesUpAfterFourFailuresInARow) {
  begin({go});
  for (int i = 0; i < 4; ++i) {
    plan.failed("the door is shut");
    observe();
    plan.planned(found(PlanReason::action_failed, {go}, plan.request().why));
    EXPECT_EQ(plan.phase(), PlanPhase::acting) << i;
  }
  plan.failed("the door is shut");
  observe();
  plan.planned(found(PlanReason::action_failed, {go}, plan.request().why));
  EXPECT_EQ(plan.phase(), PlanPhase::given_up);
  EXPECT_THAT(plan.status().why, HasSubstr("5 times in a row"));
  EXPECT_THAT(plan.status().why, HasSubstr("the door is shut"));
  EXPECT_TRUE(plan.status().steps.empty());
}

TEST_F(ContinualPlanTest, CountsFailuresAnewAfterAStepThatSucceeded) {
  begin({go});
  for (int i = 0; i < 20; ++i) {
    plan.failed("the door is shut");
    observe();
    plan.planned(found(PlanReason::action_failed, {go}));
    ASSERT_EQ(plan.phase(), PlanPhase::acting) << i;
    plan.succeeded();
    observe();
    plan.planned(found(PlanReason::state_changed, {go}));
  }
}

TEST_F(ContinualPlanTest, GivesUpWithoutAnswers) {
  for (int i = 0; i < 4; ++i) {
    plan.observation_failed("vision did not answer");
    EXPECT_EQ(plan.phase(), PlanPhase::observing);
  }
  plan.observation_failed("vision did not answer");
  EXPECT_EQ(plan.phase(), PlanPhase::given_up);
  EXPECT_THAT(plan.status().why, HasSubstr("vision did not answer"));
  ContinualPlan other{{"(g)"}, "robby"};
  for (int i = 0; i < 5; ++i) {
    other.observed({});
    other.planning_failed("the planner ended");
  }
  EXPECT_EQ(other.phase(), PlanPhase::given_up);
  EXPECT_THAT(other.status().why, HasSubstr("the planner ended"));
}

TEST_F(ContinualPlanTest, GivesUpWhatCannotBeReached) {
  begin({go});
  plan.failed("the door is shut");
  observe();
  plan.planned({PlanOutcome::unsolvable,
                {},
                PlanReason::action_failed,
                plan.request().why,
                {},
                "there is no plan"});
  EXPECT_EQ(plan.phase(), PlanPhase::given_up);
  EXPECT_EQ(plan.status().why, "there is no plan, after 'go robby hall' failed: the door is shut");
}

TEST_F(ContinualPlanTest, GivesUpAfterTooManySteps) {
  ContinualPlan bounded{{"(g)"}, "robby", {.most_in_a_row = 4, .most_steps = 2}};
  for (int i = 0; i < 2; ++i) {
    bounded.observed({});
    bounded.planned(found(PlanReason::no_plan_yet, {go}));
    bounded.succeeded();
  }
  EXPECT_EQ(bounded.phase(), PlanPhase::given_up);
  EXPECT_THAT(bounded.status().why, HasSubstr("after 2 steps"));
}

TEST_F(ContinualPlanTest, GivesUpAfterTooManyFailuresThoughOtherStepsSucceed) {
  ContinualPlan bounded{{"(g)"}, "robby", {.most_failures = 3}};
  for (int i = 0; i < 3; ++i) {
    ASSERT_FALSE(bounded.is_over());
    bounded.observed({});
    bounded.planned(found(PlanReason::state_changed, {look, go}));
    bounded.succeeded();
    bounded.observed({});
    bounded.planned({PlanOutcome::kept, {}, PlanReason::none, {}, {}, {}});
    bounded.failed("the door is shut");
  }
  EXPECT_EQ(bounded.phase(), PlanPhase::given_up);
  EXPECT_THAT(bounded.status().why, HasSubstr("it failed 3 times"));
}

TEST_F(ContinualPlanTest, PlansAnewWhereAllStepsWereDoneInVain) {
  begin({go});
  plan.succeeded();
  observe();
  EXPECT_EQ(plan.request().reason, PlanReason::state_changed);
  EXPECT_THAT(plan.request().why, HasSubstr("all steps were done"));
}

TEST_F(ContinualPlanTest, RemembersWhatItLearned) {
  begin({look, promise});
  plan.succeeded();
  observe();
  auto learned = found(PlanReason::state_changed, {go});
  learned.learned = {"excluded pos|cup hall"};
  plan.planned(learned);
  EXPECT_THAT(plan.request().learned, ElementsAre("excluded pos|cup hall"));
  EXPECT_EQ(plan.request().done, "");
}

TEST_F(ContinualPlanTest, FollowsAnotherGoal) {
  begin({go});
  plan.change_goal({"(h)", {}, {}});
  EXPECT_EQ(plan.phase(), PlanPhase::observing);
  observe();
  EXPECT_EQ(plan.request().goal, "(h)");
  EXPECT_EQ(plan.request().reason, PlanReason::goal_changed);
}

TEST_F(ContinualPlanTest, EndsWhenItIsCancelled) {
  begin({go});
  plan.cancel("somebody else wants the arm");
  EXPECT_EQ(plan.phase(), PlanPhase::cancelled);
  EXPECT_EQ(plan.status().why, "somebody else wants the arm");
}

} // namespace
} // namespace castor::planning
