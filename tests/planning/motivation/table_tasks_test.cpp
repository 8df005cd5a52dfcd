// Sentences become goals, goals plans, and plans are done by a pretended body: what is asked for is
// so in the end.
#include "castor/planning/symbolic/pddl_reader.hpp"
#include "castor/planning/symbolic/planner.hpp"
#include "castor/tests/communication/directive_sentences.hpp"
#include "castor/tests/communication/table_talk.hpp"
#include "castor/tests/planning/motivation/pretended_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace castor::planning::test {

namespace {

using communication::DirectiveStep;

const std::vector<PretendedThing> six{
  {"a", "sphere", "red", {-0.20, 0.00}, 0.06},      {"b", "sphere", "blue", {0.10, 0.12}, 0.06},
  {"c", "cube", "red", {0.00, -0.10}, 0.08},        {"d", "cube", "green", {0.22, 0.00}, 0.07},
  {"e", "cylinder", "yellow", {-0.10, 0.15}, 0.05}, {"f", "circle", "green", {-0.05, -0.22}, 0.07}};

const std::vector<std::string> all_parts{"left",       "right",    "front",     "back",
                                         "centre",     "edge",     "left-edge", "right-edge",
                                         "front-edge", "back-edge"};

std::string domain() {
  std::ifstream in{std::string{CASTOR_DOMAINS} + "/playmate.pddl"};
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// @param facts that are known besides
PlanningResult planned(const PretendedTable& table, const TableGoal& goal,
                       const std::string& facts = {}) {
  static const auto text = domain();
  constexpr std::string_view init = "(:init";
  auto problem = table.problem(goal);
  problem.insert(problem.find(init) + init.size(), facts);
  const auto read = parse_pddl("playmate.pddl", text, "table", problem);
  EXPECT_FALSE(has_errors(read.problems)) << render(read.problems);
  // What has no plan may take long to prove.
  PlanningOptions options;
  options.limits.time = std::chrono::seconds{5};
  return has_errors(read.problems) ? PlanningResult{} : find_plan(read.task, options);
}

/// The things that a plan moves or takes, in that order.
std::vector<std::string> moved(const PlanningResult& plan) {
  std::vector<std::string> result;
  for (const auto& step : plan.steps) {
    std::istringstream words{step.action};
    std::string action;
    std::string agent;
    std::string thing;
    words >> action >> agent >> thing;
    if (action == "move" || action == "take")
      result.push_back(thing);
  }
  return result;
}

enum class Outcome { done, refused, failed };

struct Result {
  Outcome outcome = Outcome::failed;
  std::string words;
  std::size_t replans = 0;
  /// What was done, a line each.
  std::string steps = {};
};

/// Plans, acts, looks at the table, and plans again until nothing is left to be done.
Result pursue(PretendedTable& table, const DirectiveStep& step) {
  const auto goal = table.begin(goal_of(step, table.things(all_parts)));
  if (goal.wish == TableWish::refusal)
    return {Outcome::refused, goal.words};
  if (goal.wish != TableWish::goal)
    return {Outcome::done, goal.words};
  Result result{Outcome::failed, goal.words};
  for (; result.replans < 4; ++result.replans) {
    const auto plan = planned(table, goal);
    if (plan.outcome != PlanningResult::Outcome::plan)
      return {Outcome::refused, explained(goal.words, "there is no way to do it"), result.replans};
    if (plan.steps.empty())
      return {Outcome::done, goal.words, result.replans, result.steps};
    for (const auto& x : plan.steps) {
      const auto problem = table.execute(x.action);
      result.steps += x.action + (problem.empty() ? "" : ": " + problem) + '\n';
      if (!problem.empty()) {
        result.words = explained(goal.words, problem);
        break;
      }
      EXPECT_FALSE(table.has_collision()) << x.action;
    }
    // Only its effect on the person or on the place tells that it was done.
    if (goal.formula.find("(pushed") != std::string::npos ||
        goal.formula.find("elsewhere") != std::string::npos ||
        goal.formula.find("aside") != std::string::npos ||
        goal.formula.find("at-hand") != std::string::npos)
      return {Outcome::done, goal.words, result.replans, result.steps};
  }
  return result;
}

struct Figures {
  std::size_t steps = 0;
  std::size_t done = 0;
  std::size_t refused = 0;
  std::size_t moves = 0;
  std::string failures;
};

Figures done_as_said(const std::string& file) {
  Figures result;
  for (const auto& sentences : communication::test::directive_sentences(file)) {
    PretendedTable table{six};
    auto scene = table.scene();
    communication::test::TableTalk talk{[&](auto& asked) { return scene->reply(asked); },
                                        [](auto&, auto) {},
                                        communication::test::words_of_requests()};
    for (const auto& sentence : sentences.said)
      for (const auto& step : talk.say(sentence).steps) {
        const auto end = pursue(table, step);
        ++result.steps;
        result.done += end.outcome == Outcome::done ? 1 : 0;
        result.refused += end.outcome == Outcome::refused ? 1 : 0;
        if (end.outcome != Outcome::done)
          result.failures += sentence + ": " + end.words + '\n';
        scene = table.scene();
      }
    result.moves += table.moves();
  }
  std::cout << result.failures << file << ": " << result.steps << " steps, " << result.done
            << " done, " << result.refused << " refused with a reason, "
            << result.steps - result.done - result.refused << " failed; " << result.moves
            << " actions\n";
  return result;
}

} // namespace

TEST(TableTasks, SwappingTakesThreeMoves) {
  PretendedTable table{six};
  const auto result = pursue(table, {"Swap", {"a", "d"}, 0, {}, {}});
  EXPECT_EQ(result.outcome, Outcome::done) << result.words;
  EXPECT_EQ(table.moves(), 3U);
  EXPECT_EQ(table.place("a"), six[3].place);
  EXPECT_EQ(table.place("d"), six[0].place);
}

TEST(TableTasks, ThingsAreSortedByColour) {
  PretendedTable table{six};
  const auto result = pursue(table, {"Sort", {"a", "b", "c", "d", "e", "f"}, 0, {}, "colour"});
  ASSERT_EQ(result.outcome, Outcome::done) << result.words;
  // Each is near to those of its colour.
  EXPECT_LT(std::abs(table.place("a").x - table.place("c").x), 0.15);
  EXPECT_LT(std::abs(table.place("d").x - table.place("f").x), 0.15);
  // None is nearer to one of another colour.
  const double together = spatial::distance(table.place("a"), table.place("c")) - 0.07;
  const double also_together = spatial::distance(table.place("d"), table.place("f")) - 0.07;
  for (const auto* red : {"a", "c"})
    for (const auto* green : {"d", "f"})
      EXPECT_GT(spatial::distance(table.place(red), table.place(green)) - 0.075,
                std::max(together, also_together));
}

TEST(TableTasks, ASideIsCleared) {
  PretendedTable table{six};
  const auto result = pursue(table, {"Clear", {}, 0, {{"left", {}}}, {}});
  ASSERT_EQ(result.outcome, Outcome::done) << result.words;
  for (const auto* name : {"a", "e", "f"})
    EXPECT_GT(table.place(name).x, 0) << name;
  EXPECT_EQ(table.moves(), 3U) << result.steps;
}

TEST(TableTasks, WhatIsInTheWayIsMovedBefore) {
  const PretendedTable table{six};
  // The second is where it ought to be already.
  TableGoal goal;
  goal.formula = "(and (in-part a right) (in-part c front))";
  goal.parts = {"right", "front"};
  goal.new_places = 3;
  EXPECT_EQ(moved(planned(table, goal)), std::vector<std::string>{"a"});
  EXPECT_EQ(moved(planned(table, goal, " (in-way c a)")), (std::vector<std::string>{"c", "a"}));
  const auto take = goal_of({"Take", {"a"}, 0, {}, {}}, table.things(all_parts));
  EXPECT_EQ(moved(planned(table, take, " (in-way c a)")), (std::vector<std::string>{"c", "a"}));
}

TEST(TableTasks, ItIsPutBackWhereItWas) {
  PretendedTable table{six};
  EXPECT_EQ(pursue(table, {"Put", {"a"}, 0, {{"on", {"c"}}}, {}}).outcome, Outcome::done);
  EXPECT_EQ(table.place("a"), table.place("c"));
  EXPECT_EQ(pursue(table, {"PutBack", {"a"}, 0, {}, {}}).outcome, Outcome::done);
  EXPECT_EQ(table.place("a"), six[0].place);
}

TEST(TableTasks, WhereThereIsNoRoomTheReasonIsSaid) {
  const std::vector<PretendedThing> crowded{{"a", "sphere", "red", {-0.2, 0}, 0.06},
                                            {"b", "cube", "blue", {0.00, 0}, 0.06},
                                            {"c", "cube", "green", {0.07, 0}, 0.06}};
  PretendedTable table{crowded};
  const auto result = pursue(table, {"Put", {"a"}, 0, {{"between", {"b", "c"}}}, {}});
  EXPECT_EQ(result.outcome, Outcome::failed);
  EXPECT_EQ(
    result.words,
    "I cannot put the red sphere between the blue cube and the green cube: there is no room.");
  PretendedTable other{crowded};
  EXPECT_EQ(pursue(other, {"Put", {"b"}, 0, {{"on", {"a"}}}, {}}).outcome, Outcome::refused);
}

TEST(TableTasks, WhatSentencesAskForIsDone) {
  const auto dev = done_as_said("dev.txt");
  EXPECT_GE(dev.steps, 120U);
  EXPECT_GE(100 * dev.done, 90 * dev.steps) << dev.failures;
  const auto heldout = done_as_said("heldout.txt");
  EXPECT_GE(100 * (heldout.done + heldout.refused), 90 * heldout.steps);
}

/// Random tables with five kinds of tasks.
TEST(TableTasks, RandomTables) {
  std::mt19937 random{11};
  std::uniform_real_distribution<double> x{-0.25, 0.25};
  std::uniform_real_distribution<double> y{-0.21, 0.21};
  const std::vector<std::string> colours{"red", "green", "blue"};
  const std::vector<std::string> relations{"left", "right", "front", "back", "near"};
  std::size_t solved = 0;
  std::size_t impossible = 0;
  std::size_t all = 0;
  std::string failures;
  for (int round = 0; round < 20; ++round) {
    std::vector<PretendedThing> things;
    std::vector<std::string> names;
    while (things.size() < 5) {
      const spatial::GroundPoint at{x(random), y(random)};
      bool is_apart = true;
      for (const auto& other : things)
        is_apart = is_apart && spatial::distance(at, other.place) > 0.09;
      if (!is_apart)
        continue;
      const auto i = things.size();
      names.push_back("t" + std::to_string(i));
      things.push_back({names.back(), i % 2 == 0 ? "cube" : "sphere", colours[i % 3], at, 0.06});
    }
    const std::vector<DirectiveStep> tasks{
      {"Put", {"t0"}, 0, {{relations[static_cast<std::size_t>(round) % 5], {"t1"}}}, {}},
      {"Take", {"t2"}, 0, {}, {}},
      {"Sort", names, 0, {}, "colour"},
      {"Clear", {}, 0, {{round % 2 == 0 ? "left" : "right", {}}}, {}},
      {"Swap", {"t3", "t4"}, 0, {}, {}}};
    for (const auto& task : tasks) {
      PretendedTable table{things};
      const auto result = pursue(table, task);
      ++all;
      solved += result.outcome == Outcome::done ? 1 : 0;
      impossible += result.outcome == Outcome::refused ? 1 : 0;
      if (result.outcome == Outcome::failed)
        failures += result.words + '\n';
    }
  }
  std::cout << "random tables: " << solved << " of " << all << " solved, " << impossible
            << " refused with a reason\n"
            << failures;
  EXPECT_GE(100 * (solved + impossible), 95 * all) << failures;
}

} // namespace castor::planning::test
