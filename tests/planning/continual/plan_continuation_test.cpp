#include "castor/planning/continual/plan_continuation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace castor::planning {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

DomainText explorer() {
  std::ostringstream out;
  out << std::ifstream(CASTOR_DOMAINS "/explorer.pddl").rdbuf();
  return {"explorer.pddl", out.str()};
}

/// The robot is to find the book; Ann, in the study, knows where it is.
FindPlan search_for_book() {
  FindPlan result;
  result.goal = "(K robby (perceived-position book))";
  result.agent = "robby";
  result.objects = {{"robby", "robot"}, {"ann", "human"},    {"hall", "room"},
                    {"study", "room"},  {"kitchen", "room"}, {"book", "thing"}};
  result.facts = {"(= (is-in robby) hall)",          "(= (is-in ann) study)",
                  "(connected hall study)",          "(connected study hall)",
                  "(connected hall kitchen)",        "(connected kitchen hall)",
                  "(K ann (asserted-position book))"};
  return result;
}

void replace(std::vector<std::string>& facts, const std::string& from, const std::string& to) {
  const auto found = std::ranges::find(facts, from);
  ASSERT_NE(found, facts.end()) << from;
  *found = to;
}

std::vector<std::string> actions_of(const FoundPlan& plan) {
  std::vector<std::string> result;
  for (const auto& x : plan.steps)
    result.push_back(x.action);
  return result;
}

const std::vector<PlannedStep> to_ask{{"move robby study hall"},
                                      {"ask-val-asserted-position robby ann book study"},
                                      {"object-search-in-room_a robby book", StepKind::assertion}};

TEST(PlanContinuation, MakesAPlan) {
  auto request = search_for_book();
  request.reason = PlanReason::no_plan_yet;
  const auto found = continue_plan(explorer(), request, {});
  EXPECT_EQ(found.outcome, PlanOutcome::changed) << found.explanation;
  EXPECT_EQ(found.steps, to_ask);
  EXPECT_EQ(found.reason, PlanReason::no_plan_yet);
}

TEST(PlanContinuation, KeepsAPlanThatStillLeadsToTheGoal) {
  auto request = search_for_book();
  request.steps = to_ask;
  EXPECT_EQ(continue_plan(explorer(), request, {}).outcome, PlanOutcome::kept);
  replace(request.facts, "(= (is-in robby) hall)", "(= (is-in robby) study)");
  request.done = to_ask[0].action;
  request.steps.erase(request.steps.begin());
  const auto found = continue_plan(explorer(), request, {});
  EXPECT_EQ(found.outcome, PlanOutcome::kept);
  EXPECT_EQ(found.steps, request.steps);
}

TEST(PlanContinuation, ReplacesAPlanThatIsNotPossibleAnyMore) {
  auto request = search_for_book();
  request.steps = to_ask;
  // Ann has gone to the kitchen.
  replace(request.facts, "(= (is-in ann) study)", "(= (is-in ann) kitchen)");
  const auto found = continue_plan(explorer(), request, {});
  EXPECT_EQ(found.outcome, PlanOutcome::changed);
  EXPECT_EQ(found.reason, PlanReason::state_changed);
  EXPECT_THAT(found.why, HasSubstr("'ask-val-asserted-position robby ann book study' is not"));
  EXPECT_EQ(actions_of(found).front(), "move robby kitchen hall");
}

TEST(PlanContinuation, ExpandsAnAssertionOnceItIsKnown) {
  auto request = search_for_book();
  replace(request.facts, "(= (is-in robby) hall)", "(= (is-in robby) study)");
  request.facts.push_back("(= (asserted-position book) kitchen)");
  request.steps = {to_ask[2]};
  request.done = to_ask[1].action;
  const auto found = continue_plan(explorer(), request, {});
  EXPECT_EQ(found.outcome, PlanOutcome::changed);
  EXPECT_EQ(found.reason, PlanReason::assertion_enabled);
  EXPECT_THAT(actions_of(found), ElementsAre("move robby hall study", "move robby kitchen hall",
                                             "object-search-in-room robby book kitchen"));
  EXPECT_EQ(found.steps.back().kind, StepKind::sensor);
}

TEST(PlanContinuation, LearnsFromASensorThatShowedNothing) {
  auto request = search_for_book();
  replace(request.facts, "(= (is-in robby) hall)", "(= (is-in robby) kitchen)");
  request.facts.push_back("(= (asserted-position book) kitchen)");
  request.done = "object-search-in-room robby book kitchen";
  request.reason = PlanReason::state_changed;
  auto found = continue_plan(explorer(), request, {});
  EXPECT_EQ(found.outcome, PlanOutcome::unsolvable);
  EXPECT_THAT(found.learned, ElementsAre("excluded perceived-position|book kitchen"));
  // It is known the next time, too, and forgotten if the book is gone from the state.
  request.learned = found.learned;
  request.done.clear();
  EXPECT_EQ(continue_plan(explorer(), request, {}).outcome, PlanOutcome::unsolvable);
  request.learned.clear();
  EXPECT_EQ(continue_plan(explorer(), request, {}).outcome, PlanOutcome::changed);
  // One that did show it teaches nothing else.
  request.done = "object-search-in-room robby book kitchen";
  request.facts.push_back("(= (perceived-position book) kitchen)");
  found = continue_plan(explorer(), request, {});
  EXPECT_EQ(found.outcome, PlanOutcome::achieved);
  EXPECT_TRUE(found.learned.empty());
}

TEST(PlanContinuation, SeesThatTheGoalHoldsWhateverHappenedBefore) {
  auto request = search_for_book();
  request.facts.push_back("(= (perceived-position book) hall)");
  for (const auto reason : {PlanReason::none, PlanReason::no_plan_yet, PlanReason::action_failed}) {
    request.reason = reason;
    EXPECT_EQ(continue_plan(explorer(), request, {}).outcome, PlanOutcome::achieved);
  }
}

TEST(PlanContinuation, RefusesWhatItDoesNotUnderstand) {
  auto request = search_for_book();
  request.facts.push_back("(= (is-in bob) hall)");
  auto found = continue_plan(explorer(), request, {});
  EXPECT_EQ(found.outcome, PlanOutcome::refused);
  EXPECT_THAT(found.explanation, HasSubstr("(= (is-in bob) hall)"));
  EXPECT_THAT(found.explanation, HasSubstr("there is no object 'bob'"));
  request = search_for_book();
  request.objects.push_back({"Bob", "human"});
  found = continue_plan(explorer(), request, {});
  EXPECT_EQ(found.outcome, PlanOutcome::refused);
  EXPECT_THAT(found.explanation, HasSubstr("call it 'bob'"));
}

TEST(PlanContinuation, EndsAtItsLimits) {
  auto request = search_for_book();
  request.steps = to_ask;
  PlanningOptions options;
  options.limits.groundings = 1;
  for (const auto reason : {PlanReason::none, PlanReason::no_plan_yet}) {
    request.reason = reason;
    EXPECT_EQ(continue_plan(explorer(), request, options).outcome, PlanOutcome::unknown);
  }
}

} // namespace
} // namespace castor::planning
