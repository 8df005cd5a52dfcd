#include "castor/actors/task_manager/task_schedule.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace castor::test {

namespace {

TaskProposal task(const TaskId& id, TaskOptions options = {}) {
  return {id, "name of " + id, "m", std::move(options)};
}

/// "a adopted, b waiting: it waits for a"
std::string text(const TaskSchedule::Decisions& decisions) {
  std::string result;
  for (auto& x : decisions) {
    result += (result.empty() ? "" : ", ") + x.id;
    for (auto& [name, value] : reflection_of<TaskDecision>().enumerators)
      if (value == x.decision)
        result += ' ' + std::string{name};
    if (!x.reason.empty())
      result += ": " + x.reason;
  }
  return result;
}

std::string propose(TaskSchedule& schedule, const TaskId& id, TaskOptions options = {}) {
  return text(schedule.propose(task(id, std::move(options))));
}

std::string succeed(TaskSchedule& schedule, const TaskId& id) {
  return text(schedule.complete(id, TaskOutcome::success));
}

// --- budget ---

TEST(TaskSchedule, AdoptsWhatFitsTheBudgetAndTheRestLater) {
  TaskSchedule schedule{{.budget = 2}};
  EXPECT_EQ(propose(schedule, "a"), "a adopted");
  EXPECT_EQ(propose(schedule, "b"), "b adopted");
  EXPECT_EQ(propose(schedule, "c"), "c waiting: it costs 1, and 2 of the budget of 2 is taken");
  EXPECT_EQ(schedule.used(), 2);
  EXPECT_EQ(succeed(schedule, "a"), "c adopted");
  EXPECT_EQ(succeed(schedule, "b"), "");
  EXPECT_EQ(schedule.used(), 1);
}

TEST(TaskSchedule, OneEndMayLetSeveralIn) {
  TaskSchedule schedule{{.budget = 3}};
  propose(schedule, "a", {.cost = 3});
  for (auto id : {"b", "c", "d", "e"})
    propose(schedule, id);
  EXPECT_EQ(succeed(schedule, "a"), "b adopted, c adopted, d adopted");
}

TEST(TaskSchedule, ATaskBeyondTheWholeBudgetIsRejected) {
  TaskSchedule schedule{{.budget = 2}};
  EXPECT_EQ(propose(schedule, "a", {.cost = 2.5}),
            "a rejected: it costs 2.5, more than the whole budget of 2");
  EXPECT_EQ(propose(schedule, "b", {.cost = 2}), "b adopted");
}

TEST(TaskSchedule, ACostIsAFiniteNumberFromZero) {
  TaskSchedule schedule{{.budget = 2}};
  EXPECT_EQ(propose(schedule, "a", {.cost = -1}),
            "a rejected: its cost is -1, but a cost is a number from 0");
  for (auto cost :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(schedule.propose(task("b", {.cost = cost})).front().decision, TaskDecision::rejected);
}

TEST(TaskSchedule, WhatCostsNothingFitsWithoutABudget) {
  TaskSchedule schedule{{.budget = 0}};
  EXPECT_EQ(propose(schedule, "a", {.cost = 0}), "a adopted");
  EXPECT_EQ(propose(schedule, "b"), "b rejected: it costs 1, more than the whole budget of 0");
}

TEST(TaskSchedule, TenthsAddUp) {
  TaskSchedule schedule{{.budget = 0.3}};
  for (auto id : {"a", "b", "c"})
    EXPECT_EQ(propose(schedule, id, {.cost = 0.1}), id + std::string{" adopted"});
  EXPECT_EQ(propose(schedule, "d", {.cost = 0.1}),
            "d waiting: it costs 0.1, and 0.3 of the budget of 0.3 is taken");
}

// --- order ---

TEST(TaskSchedule, TheHighestPriorityComesFirstThenTheOldest) {
  TaskSchedule schedule{{}};
  propose(schedule, "running");
  propose(schedule, "low", {.priority = std::numeric_limits<int>::min()});
  propose(schedule, "first");
  propose(schedule, "second");
  propose(schedule, "high", {.priority = 7});
  std::string order;
  for (TaskId id = "running";;) {
    auto decisions = schedule.complete(id, TaskOutcome::success);
    if (decisions.empty())
      break;
    id = decisions.front().id;
    order += id + ' ';
  }
  EXPECT_EQ(order, "high first second low ");
}

TEST(TaskSchedule, ALargeTaskIsNotOvertaken) {
  TaskSchedule schedule{{.budget = 2}};
  propose(schedule, "a");
  EXPECT_EQ(propose(schedule, "large", {.cost = 2}),
            "large waiting: it costs 2, and 1 of the budget of 2 is taken");
  EXPECT_EQ(propose(schedule, "small"), "small waiting: large comes first");
  EXPECT_EQ(propose(schedule, "urgent", {.priority = 1}), "urgent adopted")
    << "it is not behind the large one";
  EXPECT_EQ(succeed(schedule, "a"), "");
  EXPECT_EQ(succeed(schedule, "urgent"), "large adopted");
}

TEST(TaskSchedule, WithBackfillItIs) {
  TaskSchedule schedule{{.budget = 2, .backfill = true}};
  propose(schedule, "a");
  propose(schedule, "large", {.priority = 5, .cost = 2});
  EXPECT_EQ(propose(schedule, "small"), "small adopted");
  EXPECT_EQ(propose(schedule, "next"),
            "next waiting: it costs 1, and 2 of the budget of 2 is taken");
  EXPECT_EQ(succeed(schedule, "a"), "next adopted");
  EXPECT_EQ(succeed(schedule, "small"), "");
  EXPECT_EQ(succeed(schedule, "next"), "large adopted");
}

TEST(TaskSchedule, ATaskThatGoesAwayBlocksNoLonger) {
  TaskSchedule schedule{{.budget = 2}};
  propose(schedule, "a");
  propose(schedule, "large", {.cost = 2});
  propose(schedule, "small");
  EXPECT_EQ(text(schedule.retract("large")), "small adopted");
}

// --- predecessors ---

TEST(TaskSchedule, ATaskComesAfterAllItsPredecessors) {
  TaskSchedule schedule{{.budget = 5}};
  propose(schedule, "a");
  propose(schedule, "b");
  EXPECT_EQ(propose(schedule, "c", {.after = {"b", "a", "b"}}), "c waiting: it waits for a, b");
  EXPECT_EQ(succeed(schedule, "a"), "");
  EXPECT_EQ(succeed(schedule, "b"), "c adopted");
}

TEST(TaskSchedule, ATaskThatWaitsForOthersHoldsNobodyUp) {
  TaskSchedule schedule{{.budget = 2}};
  propose(schedule, "a");
  propose(schedule, "b", {.priority = 9, .after = {"a"}});
  EXPECT_EQ(propose(schedule, "c"), "c adopted");
}

TEST(TaskSchedule, APredecessorThatHasSucceededIsNotWaitedFor) {
  TaskSchedule schedule{{}};
  propose(schedule, "a");
  succeed(schedule, "a");
  EXPECT_EQ(propose(schedule, "b", {.after = {"a"}}), "b adopted");
}

TEST(TaskSchedule, APredecessorThatNobodyHasProposedIsWaitedFor) {
  TaskSchedule schedule{{}};
  EXPECT_EQ(propose(schedule, "b", {.after = {"a"}}),
            "b waiting: it waits for a (not proposed so far)");
  EXPECT_EQ(propose(schedule, "a"), "a adopted");
  EXPECT_EQ(succeed(schedule, "a"), "b adopted");
}

TEST(TaskSchedule, WithAPredecessorFallAllThatComeAfterIt) {
  struct {
    std::string how;
    TaskSchedule::Decisions (*end)(TaskSchedule&);
  } const ends[] = {
    {"failed", [](auto& x) { return x.complete("a", TaskOutcome::failure); }},
    {"was left incomplete", [](auto& x) { return x.complete("a", TaskOutcome::incomplete); }},
    {"was retracted", [](auto& x) { return x.retract("a"); }},
  };
  for (auto& [how, end] : ends) {
    TaskSchedule schedule{{}};
    propose(schedule, "a");
    propose(schedule, "b", {.after = {"a"}});
    propose(schedule, "c", {.after = {"b", "a"}});
    propose(schedule, "d", {.after = {"b", "c"}});
    propose(schedule, "e");
    EXPECT_EQ(text(end(schedule)),
              "b rejected: its predecessor a " + how + ", c rejected: its predecessor a " + how +
                ", d rejected: its predecessor b was rejected, since a " + how + ", e adopted");
    EXPECT_EQ(propose(schedule, "f", {.after = {"a"}}), "f rejected: its predecessor a " + how);
    EXPECT_EQ(propose(schedule, "g", {.after = {"d"}}),
              "g rejected: its predecessor d was rejected");
  }
}

TEST(TaskSchedule, ARejectedTaskTakesThoseThatAwaitedItAlong) {
  TaskSchedule schedule{{}};
  propose(schedule, "b", {.after = {"a"}});
  EXPECT_EQ(propose(schedule, "a", {.cost = 2}),
            "a rejected: it costs 2, more than the whole budget of 1, "
            "b rejected: its predecessor a was rejected");
}

TEST(TaskSchedule, ACycleIsRejectedWhenItCloses) {
  TaskSchedule schedule{{}};
  EXPECT_EQ(propose(schedule, "a", {.after = {"c"}}),
            "a waiting: it waits for c (not proposed so far)");
  EXPECT_EQ(propose(schedule, "b", {.after = {"a"}}), "b waiting: it waits for a");
  EXPECT_EQ(propose(schedule, "c", {.after = {"b"}}),
            "c rejected: its predecessors form a cycle: c waits for b, which waits for a, which "
            "waits for c, a rejected: its predecessor c was rejected, "
            "b rejected: its predecessor a was rejected, since c was rejected");
  EXPECT_EQ(propose(schedule, "d", {.after = {"d"}}),
            "d rejected: its predecessors form a cycle: d waits for d");
}

// --- ends ---

TEST(TaskSchedule, ARetractedTaskFreesItsShare) {
  TaskSchedule schedule{{}};
  propose(schedule, "a");
  propose(schedule, "b");
  EXPECT_EQ(text(schedule.retract("a")), "b adopted");
  EXPECT_EQ(text(schedule.retract("b")), "");
  EXPECT_EQ(schedule.used(), 0);
}

TEST(TaskSchedule, UnknownIdsAreIgnored) {
  TaskSchedule schedule{{}};
  EXPECT_EQ(text(schedule.retract("a")), "");
  EXPECT_EQ(succeed(schedule, "a"), "");
  EXPECT_EQ(propose(schedule, "b", {.after = {"a"}}),
            "b waiting: it waits for a (not proposed so far)")
    << "a is still unknown";
}

TEST(TaskSchedule, AWaitingTaskMayBeDoneWithoutHavingBeenAdopted) {
  TaskSchedule schedule{{}};
  propose(schedule, "a");
  propose(schedule, "b");
  propose(schedule, "c", {.priority = 1, .after = {"b"}});
  EXPECT_EQ(succeed(schedule, "b"), "");
  EXPECT_EQ(succeed(schedule, "a"), "c adopted");
}

TEST(TaskSchedule, ANewTaskByAnOldIdTakesItsPlace) {
  TaskSchedule schedule{{}};
  propose(schedule, "a");
  propose(schedule, "b", {.after = {"a"}});
  EXPECT_EQ(propose(schedule, "a"), "b rejected: its predecessor a was retracted, a adopted");
  EXPECT_EQ(schedule.used(), 1);
  text(schedule.complete("a", TaskOutcome::failure));
  EXPECT_EQ(propose(schedule, "a"), "a adopted");
  EXPECT_EQ(propose(schedule, "c", {.after = {"a"}}), "c waiting: it waits for a")
    << "the failure was that of the former one";
}

TEST(TaskSchedule, RemembersOnlySoManyEnds) {
  TaskSchedule schedule{{.remembered = 2}};
  for (auto id : {"a", "b", "c"}) {
    propose(schedule, id);
    succeed(schedule, id);
  }
  EXPECT_EQ(propose(schedule, "d", {.after = {"b", "c"}}), "d adopted");
  EXPECT_EQ(propose(schedule, "e", {.after = {"a"}}),
            "e waiting: it waits for a (not proposed so far)");
}

TEST(TaskSchedule, AnOldIdUsedAgainIsForgottenInItsNewTurn) {
  TaskSchedule schedule{{.remembered = 2}};
  for (auto id : {"a", "b", "a", "c"}) {
    propose(schedule, id);
    succeed(schedule, id);
  }
  EXPECT_EQ(propose(schedule, "d", {.after = {"a", "c"}}), "d adopted");
}

} // namespace

} // namespace castor::test
