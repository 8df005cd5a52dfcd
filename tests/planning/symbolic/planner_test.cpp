#include "castor/planning/symbolic/planner.hpp"

#include "castor/planning/symbolic/pddl_reader.hpp"
#include "castor/tests/planning/symbolic/domains.hpp"
#include "castor/tests/planning/symbolic/validator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace castor::planning {
namespace {

using ::testing::HasSubstr;
using Outcome = PlanningResult::Outcome;

PlanningResult planned(const std::string& domain, const std::string& problem,
                       const PlanningOptions& options = {}) {
  const auto read = parse_pddl("d.pddl", domain, "p.pddl", problem);
  EXPECT_FALSE(has_errors(read.problems)) << render(read.problems);
  auto result = find_plan(read.task, options);
  if (result.outcome == Outcome::plan) {
    std::vector<std::string> plan;
    for (const auto& x : result.steps)
      plan.push_back(x.action);
    EXPECT_EQ(test::validate(test::PddlModel(domain, problem), plan, result.cost), "");
  }
  return result;
}

std::string lamps_problem(const std::string& initial, const std::string& goal) {
  return "(define (problem p) (:domain lamps) (:objects a b c d - node) (:init (source a) (wire a "
         "b) "
         "(wire b c) (wire c d) " +
         initial + ") (:goal " + goal + "))";
}

TEST(PlannerTest, FindsTheCheapestPlanIfItHasTime) {
  PlanningOptions options;
  options.is_anytime = true;
  const auto result = planned(test::cups_domain, test::cups_problem, options);
  ASSERT_EQ(result.outcome, Outcome::plan);
  EXPECT_EQ(result.cost, 14);
  EXPECT_TRUE(result.is_optimal);
  EXPECT_THAT(explain(result), HasSubstr("none costs less"));
}

TEST(PlannerTest, ProvesThatAGoalCannotBeReached) {
  auto problem = test::cups_problem;
  // Both hands full is never allowed, though each is possible alone: only search shows it.
  const std::string goal = "(and (at red study) (at blue kitchen))";
  problem.replace(problem.find(goal), goal.size(), "(and (holding red) (holding blue))");
  const auto result = planned(test::cups_domain, problem);
  EXPECT_EQ(result.outcome, Outcome::unsolvable);
  EXPECT_THAT(explain(result), HasSubstr("there is no plan"));
  // Without doors, it is clear before the search.
  const auto shut =
    planned(test::cups_domain, "(define (problem p) (:domain cups) (:objects a b - room c - cup)"
                               "(:init (robot-at a) (at c b)) (:goal (holding c)))");
  EXPECT_EQ(shut.outcome, Outcome::unsolvable);
  EXPECT_EQ(shut.counts.expanded, 0U);
}

TEST(PlannerTest, NeedsNoActionsForAGoalThatHolds) {
  const auto result =
    planned(test::cups_domain, "(define (problem p) (:domain cups) (:objects a - room)"
                               "(:init (robot-at a)) (:goal (robot-at a)))");
  EXPECT_EQ(result.outcome, Outcome::plan);
  EXPECT_TRUE(result.steps.empty());
}

TEST(PlannerTest, UnderstandsAdlAndDerivedPredicates) {
  EXPECT_EQ(planned(test::lamps_domain, lamps_problem("", "(live d)")).steps.size(), 3U);
  // What is on is switched off.
  EXPECT_EQ(planned(test::lamps_domain, lamps_problem("(on a b) (on b c)", "(dark)")).steps.size(),
            1U);
  EXPECT_EQ(planned(test::lamps_domain, lamps_problem("(broken c)", "(live d)")).outcome,
            Outcome::unsolvable);
  EXPECT_EQ(
    planned(test::lamps_domain,
            lamps_problem("(on b c) (broken b)",
                          "(and (live b) (not (live c)) (forall (?x - node) (not (on ?x d))))"))
      .outcome,
    Outcome::plan);
  EXPECT_EQ(planned(test::lamps_domain,
                    lamps_problem("", "(exists (?x - node) (and (live ?x) (not (source ?x))))"))
              .steps.size(),
            1U);
}

/// Problems whose search is long: a counter of many bits that counts up one by one.
std::string counter_domain(int bits) {
  std::string result = "(define (domain counter) (:predicates";
  for (int i = 0; i < bits; ++i)
    result += " (b" + std::to_string(i) + ")";
  result += ")";
  for (int i = 0; i < bits; ++i) {
    result +=
      "(:action inc" + std::to_string(i) + " :precondition (and (not (b" + std::to_string(i) + "))";
    for (int k = 0; k < i; ++k)
      result += "(b" + std::to_string(k) + ")";
    result += ") :effect (and (b" + std::to_string(i) + ")";
    for (int k = 0; k < i; ++k)
      result += "(not (b" + std::to_string(k) + "))";
    result += "))";
  }
  return result + ")";
}

std::string counter_problem(int bits) {
  std::string result = "(define (problem p) (:domain counter) (:init) (:goal (and";
  for (int i = 0; i < bits; ++i)
    result += " (b" + std::to_string(i) + ")";
  return result + ")))";
}

TEST(PlannerTest, CountsThroughAllStates) {
  const auto result = planned(counter_domain(8), counter_problem(8));
  ASSERT_EQ(result.outcome, Outcome::plan);
  EXPECT_EQ(result.steps.size(), 255U);
}

TEST(PlannerTest, EndsHonestlyAtItsLimits) {
  PlanningOptions options;
  options.limits.time = std::chrono::milliseconds(100);
  const auto late = planned(counter_domain(40), counter_problem(40), options);
  EXPECT_EQ(late.outcome, Outcome::unknown);
  EXPECT_EQ(late.limit, LimitReached::time);
  EXPECT_LT(late.seconds, 5);
  EXPECT_THAT(explain(late), HasSubstr("the time is over"));

  options.limits.time.reset();
  options.limits.memory_bytes = std::size_t{1} << 20;
  EXPECT_EQ(planned(counter_domain(40), counter_problem(40), options).limit, LimitReached::memory);

  options.limits = {};
  options.limits.groundings = 10;
  EXPECT_EQ(planned(test::cups_domain, test::cups_problem, options).limit,
            LimitReached::groundings);
}

TEST(PlannerTest, IsCancelledWhileItSaysHowFarItIs) {
  std::atomic<bool> is_cancelled = false;
  PlanningOptions options;
  options.limits.is_cancelled = &is_cancelled;
  std::chrono::steady_clock::time_point when;
  options.on_progress = [&](const PlanningProgress& x) {
    EXPECT_GT(x.expanded, 0U);
    EXPECT_FALSE(x.best_cost);
    if (!is_cancelled.exchange(true))
      when = std::chrono::steady_clock::now();
  };
  const auto result = planned(counter_domain(40), counter_problem(40), options);
  EXPECT_EQ(result.limit, LimitReached::cancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - when, std::chrono::seconds(1));
}

const std::string quadruples_domain = "(define (domain d) (:predicates (p ?a ?b ?c ?d)) (:action a "
                                      ":parameters (?a ?b ?c ?d) :effect (p ?a ?b ?c ?d)))";

/// Has the fourth power of `objects` as actions without variables.
std::string quadruples_problem(int objects) {
  std::string result = "(define (problem p) (:domain d) (:objects";
  for (int i = 0; i < objects; ++i)
    result += " o" + std::to_string(i);
  return result + ") (:init) (:goal (p o1 o2 o3 o4)))";
}

TEST(PlannerTest, IsCancelledInTheMiddleOfGrounding) {
  using Clock = std::chrono::steady_clock;
  const auto read = parse_pddl("d", quadruples_domain, "p", quadruples_problem(40));
  ASSERT_FALSE(has_errors(read.problems)) << render(read.problems);
  for (const int delay : {0, 10, 100, 300}) {
    std::atomic<bool> is_cancelled = false;
    Clock::time_point when;
    std::jthread canceller([&] {
      const auto begin = Clock::now();
      while (Clock::now() - begin < std::chrono::milliseconds(delay))
        std::this_thread::yield();
      when = Clock::now();
      is_cancelled = true;
    });
    PlanningOptions options;
    options.limits.is_cancelled = &is_cancelled;
    const auto result = find_plan(read.task, options);
    const auto end = Clock::now();
    canceller.join();
    EXPECT_EQ(result.limit, LimitReached::cancelled);
    EXPECT_LT(end - when, std::chrono::seconds(1)) << "after " << delay << " ms";
  }
}

TEST(PlannerTest, EndsGroundingOfTooManyActions) {
  PlanningOptions options;
  options.limits.groundings = 100'000;
  const auto result = planned(quadruples_domain, quadruples_problem(300), options);
  EXPECT_EQ(result.limit, LimitReached::groundings);
}

} // namespace
} // namespace castor::planning
