// The planner as a component: it tells how far it is, and is cancelled at once.

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <string>

namespace castor::planning::test {

struct Cancelled {
  ActionOutcome outcome = ActionOutcome::none;
  std::string reason;
  double milliseconds = 0;
};
CASTOR_REFLECT(Cancelled, outcome, reason, milliseconds)

namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// Asks for a plan, and cancels that when the planner has told how far it is.
class HastyAsker final : public UnmanagedComponent {
  void run() override {
    FindPlan request;
    request.goal = goal_;
    request.reason = PlanReason::no_plan_yet;
    auto action = perform("planning", request);
    while (read_where_in<PlannerProgress>("planning", field(&PlannerProgress::is_planning) == true)
             .empty())
      sleep_for(1ms);
    const auto begin = now();
    action.cancel();
    const auto end = action.wait(1min);
    const std::chrono::duration<double, std::milli> passed = now() - begin;
    add(here("cancelled"), Cancelled{end.outcome, end.reason, passed.count()});
  }

  Option<std::string> goal_{this, "goal", "", "the goal"};
};

CASTOR_COMPONENT(HastyAsker, "asks for plans, and does not wait for them")

/// What is measured of one cancellation.
Cancelled cancelled(const std::string& domain, const std::string& goal) {
  const castor::test::TemporaryFolder folder;
  const auto file = folder / "domain.pddl";
  std::ofstream{file} << domain;
  const std::string sa = "CPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n";
  TestSystem system{"HOST localhost\nSUBARCHITECTURE planning\n" + sa +
                    "CPP MG planner SymbolicPlanner --time 10min --domain " + file.string() +
                    "\nSUBARCHITECTURE owner\n" + sa + "CPP UM owner HastyAsker --goal \"" + goal +
                    "\"\n"};
  auto result = *system.expect_entry("Cancelled in owner", 1min)->value.as<Cancelled>();
  system.expect_entry("PlannerProgress in planning where is_planning == false");
  system.expect_nobody_else_down();
  return result;
}

void expect_soon(const Cancelled& x) {
  EXPECT_EQ(x.outcome, ActionOutcome::cancelled);
  EXPECT_THAT(x.reason, HasSubstr("ended its search"));
  // Usually within a few milliseconds; machines that test are busy.
  EXPECT_LT(x.milliseconds, 1000);
  testing::Test::RecordProperty("milliseconds", std::to_string(x.milliseconds));
}

TEST(SymbolicPlannerComponent, IsCancelledWhileItGrounds) {
  std::string constants;
  for (int i = 0; i < 60; ++i)
    constants += " o" + std::to_string(i);
  expect_soon(cancelled("(define (domain d) (:constants" + constants +
                          ") (:predicates (p ?a ?b ?c ?d)) (:action a :parameters (?a ?b ?c ?d) "
                          ":effect (p ?a ?b ?c ?d)))",
                        "(p o1 o2 o3 o4)"));
}

TEST(SymbolicPlannerComponent, IsCancelledWhileItSearches) {
  // A counter of many bits, which counts up one by one.
  std::string domain = "(define (domain counter) (:predicates";
  std::string goal = "(and";
  for (int i = 0; i < 40; ++i) {
    domain += " (b" + std::to_string(i) + ")";
    goal += " (b" + std::to_string(i) + ")";
  }
  domain += ")";
  for (int i = 0; i < 40; ++i) {
    std::string lower;
    std::string effect = "(b" + std::to_string(i) + ")";
    for (int k = 0; k < i; ++k) {
      lower += "(b" + std::to_string(k) + ")";
      effect += "(not (b" + std::to_string(k) + "))";
    }
    domain += "(:action inc" + std::to_string(i) + " :precondition (and (not (b" +
              std::to_string(i) + "))" + lower + ") :effect (and " + effect + "))";
  }
  expect_soon(cancelled(domain + ")", goal + ")"));
}

} // namespace

} // namespace castor::planning::test
