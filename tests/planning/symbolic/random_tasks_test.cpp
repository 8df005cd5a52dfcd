#include "castor/planning/symbolic/pddl_reader.hpp"
#include "castor/planning/symbolic/planner.hpp"
#include "castor/tests/planning/symbolic/validator.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <deque>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {
namespace {

using Outcome = PlanningResult::Outcome;

/// Small tasks of all that the reader accepts, in random combination.
class RandomTask {
public:
  explicit RandomTask(unsigned seed) : random_(seed) {
    domain = "(define (domain r) (:requirements :adl :derived-predicates) (:types t u - object) "
             "(:constants a b - t c - u) "
             "(:predicates (p) (q ?x - t) (s ?x - t) (e ?x ?y - t) (v ?x - u) (d ?x - t) (n))";
    if (chance(3)) {
      derived_ = true;
      domain += "(:derived (d ?x - t) (or (and (q ?x) " + literal({"?x"}, false) +
                ") (exists (?y - t) (and (e ?y ?x) (d ?y)))))"
                "(:derived (n) (not (d a)))";
    }
    const int actions = 3 + number(4);
    for (int i = 0; i < actions; ++i)
      add_action(i);
    domain += ")";
    problem = "(define (problem r1) (:domain r) (:init";
    for (const char* x : {"(p)", "(q a)", "(q b)", "(s a)", "(s b)", "(e a b)", "(e b a)", "(v c)"})
      if (chance(4))
        problem += ' ' + std::string(x);
    problem += ") (:goal (and ";
    for (int i = 0; i < 3; ++i)
      problem += i == 0 ? condition({}) : atom({}, derived_);
    problem += ")))";
  }

  std::string domain;
  std::string problem;

private:
  int number(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
  bool chance(int of) { return number(of) == 0; }

  std::string term(const std::vector<std::string>& variables) {
    const auto i = static_cast<std::size_t>(number(static_cast<int>(variables.size()) + 2));
    return i < variables.size() ? variables[i] : (i - variables.size() == 0 ? "a" : "b");
  }

  std::string atom(const std::vector<std::string>& variables, bool with_derived) {
    switch (number(with_derived ? 7 : 5)) {
      case 0:
        return "(p)";
      case 1:
        return "(q " + term(variables) + ")";
      case 2:
        return "(s " + term(variables) + ")";
      case 3:
        return "(e " + term(variables) + " " + term(variables) + ")";
      case 4:
        return "(v c)";
      case 5:
        return "(d " + term(variables) + ")";
      default:
        return "(n)";
    }
  }

  std::string literal(const std::vector<std::string>& variables, bool with_derived) {
    const auto x = atom(variables, with_derived);
    return chance(3) ? "(not " + x + ")" : x;
  }

  std::string condition(std::vector<std::string> variables) {
    switch (number(8)) {
      case 0:
        return "(or " + literal(variables, derived_) + literal(variables, derived_) + ")";
      case 1:
      case 2: {
        const std::string head = chance(2) ? "(forall" : "(exists";
        variables.push_back("?z");
        return head + " (?z - t) " + condition(variables) + ")";
      }
      case 3:
        return "(imply " + literal(variables, derived_) + literal(variables, derived_) + ")";
      case 4:
        return "(not (= " + term(variables) + " " + term(variables) + "))";
      default:
        return literal(variables, derived_);
    }
  }

  void add_action(int i) {
    std::vector<std::string> variables;
    std::string parameters;
    for (int k = number(3); k > 0; --k) {
      variables.push_back("?x" + std::to_string(k));
      parameters += variables.back() + " - t ";
    }
    domain += "(:action a" + std::to_string(i) + " :parameters (" + parameters +
              ") :precondition (and " + condition(variables) + condition(variables) +
              ") :effect (and " + literal(variables, false);
    if (chance(2))
      domain += literal(variables, false);
    if (chance(2))
      domain += "(when " + condition(variables) + literal(variables, false) + ")";
    if (chance(4)) {
      auto inner = variables;
      inner.push_back("?w");
      domain += "(forall (?w - t) (when " + condition(inner) + literal(inner, false) + "))";
    }
    domain += "))";
  }

  std::mt19937 random_;
  bool derived_ = false;
};

/// Length of the shortest plan, by looking at all states; -1 if there is none.
int shortest_plan(const test::PddlModel& model) {
  std::deque<std::pair<test::Atoms, int>> queue{{model.initial(), 0}};
  std::set<test::Atoms> seen{model.initial()};
  const auto actions = model.all_actions();
  while (!queue.empty()) {
    const auto [state, length] = std::move(queue.front());
    queue.pop_front();
    if (model.is_goal(state))
      return length;
    for (const auto& x : actions)
      if (auto next = model.after(state, x); next && seen.insert(*next).second)
        queue.emplace_back(std::move(*next), length + 1);
  }
  return -1;
}

/// CASTOR_RANDOM_TASKS is how many, if more than usual are wanted.
TEST(RandomTasksTest, PlansAreRightAndAreFoundIfThereAreAny) {
  const char* wanted = std::getenv("CASTOR_RANDOM_TASKS");
  const unsigned count = wanted ? static_cast<unsigned>(std::strtoul(wanted, nullptr, 10)) : 300;
  unsigned solvable = 0;
  unsigned longer = 0;
  for (unsigned seed = 0; seed < count; ++seed) {
    const RandomTask random(seed);
    const auto text = std::to_string(seed) + "\n" + random.domain + "\n" + random.problem;
    const auto read = parse_pddl("d", random.domain, "p", random.problem);
    ASSERT_FALSE(has_errors(read.problems)) << text << render(read.problems);
    PlanningOptions options;
    options.is_anytime = seed % 2 == 0;
    const auto result = find_plan(read.task, options);
    const test::PddlModel model(random.domain, random.problem);
    const int shortest = shortest_plan(model);
    ASSERT_EQ(result.outcome, shortest < 0 ? Outcome::unsolvable : Outcome::plan)
      << text << explain(result);
    if (shortest < 0)
      continue;
    ++solvable;
    longer += shortest > 1 ? 1 : 0;
    std::vector<std::string> plan;
    for (const auto& x : result.steps)
      plan.push_back(x.action);
    ASSERT_EQ(test::validate(model, plan, result.cost), "") << text;
    ASSERT_GE(result.cost, shortest) << text;
    if (options.is_anytime) {
      ASSERT_TRUE(result.is_optimal) << text;
      ASSERT_EQ(result.cost, shortest) << text;
    }
  }
  // Both kinds have to be among them, and not only trivial ones.
  EXPECT_GT(solvable, count / 10);
  EXPECT_GT(longer, count / 50);
  EXPECT_LT(solvable, count);
}

} // namespace
} // namespace castor::planning
