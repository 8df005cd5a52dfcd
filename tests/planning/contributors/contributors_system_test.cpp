// Planning with what binding and the navigation graph say: the state is put together of both, and
// goals are reached in it.

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/mapping/graph/types.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace castor::planning::contributors_test {

/// How a goal ended.
struct Reached {
  ActionOutcome outcome = ActionOutcome::none;
  std::string reason;
};
CASTOR_REFLECT(Reached, outcome, reason)

namespace {

using namespace std::chrono_literals;
using binding::BindingProxy;
using binding::feature;
using binding::FeatureKind;
using ::testing::Contains;

/// Sees a red ball left of a box, and a robot arm puts things where they are to be.
class SeenTable final : public binding::BindingMonitor {
  void start() override {
    BindingMonitor::start();
    put_thing("ball", "red", 0.1);
    put_thing("box", "unknown", 0.4);
    relate("left", "ball", "box");
    publish();
    // Which place the arm has chosen only the arm knows.
    on_call<StateRequest>([this](const StateRequest&) { return StateReply{{}, chosen_}; });
    on_action<PlannedAction>([this](ActionInProgress& action, const PlannedAction& step) {
      if (step.name == "reposition-left")
        chosen_ = {"(wp-left-of " + step.arguments.at(1) + " " + step.arguments.at(2) + ")",
                   "(chosen " + step.arguments.at(1) + ")"};
      else
        move(action);
      return ActionResult::succeeded();
    });
  }

  void move(ActionInProgress& action) {
    chosen_.clear();
    relate("left", "box", "ball");
    withdraw("left of ball and box");
    publish();
    // Until it can be asked for.
    const binding::UnionRelation wanted{"left", "union of place of box", "union of place of ball"};
    for (;;) {
      const auto relations = bound().relations;
      if (std::ranges::find(relations, wanted) != relations.end() || !action.sleep_for(1ms))
        return;
    }
  }

  binding::ReferenceReply bound() {
    return call<binding::ReferenceRequest, binding::ReferenceReply>("binding", {}, {.timeout = 5s});
  }

  BindingProxy perceived() const {
    BindingProxy result;
    result.features = {feature(FeatureKind::temporal_frame, binding::perceived_frame),
                       binding::not_from(subarchitecture())};
    return result;
  }

  void put_thing(const std::string& name, const std::string& colour, double x) {
    auto thing = perceived();
    thing.features.push_back(feature(FeatureKind::concept_name, "thing"));
    thing.features.push_back(feature(FeatureKind::colour, colour));
    auto place = perceived();
    place.features.push_back(binding::location_at(x, 0, 0, "table"));
    auto position = perceived();
    position.type = binding::ProxyType::relation;
    position.features.push_back(feature(FeatureKind::relation_label, binding::position_label));
    position.out_ports = {{binding::from_port, "place of " + name, {}},
                          {binding::to_port, name, {}}};
    tell(name, thing);
    tell("place of " + name, place);
    tell("position of " + name, position);
  }

  void relate(const std::string& label, const std::string& a, const std::string& b) {
    auto relation = perceived();
    relation.type = binding::ProxyType::relation;
    relation.features.push_back(feature(FeatureKind::relation_label, label));
    relation.out_ports = {{binding::from_port, "place of " + a, {}},
                          {binding::to_port, "place of " + b, {}}};
    tell(label + " of " + a + " and " + b, relation);
  }

  std::vector<std::string> chosen_;
};

CASTOR_COMPONENT(SeenTable, "sees two things on a table")

/// A map of three rooms in a row, through which the robot drives.
class DrivenMap final : public ManagedComponent {
  void start() override {
    const std::string names[] = {"hall", "corridor", "kitchen"};
    for (std::int64_t i = 0; i < 3; ++i) {
      mapping::Area area;
      area.id = i;
      area.label = names[i];
      add(here("area-" + std::to_string(i)), area);
      mapping::GraphNode place;
      place.id = 2 * i;
      place.area = i;
      add(here("node-" + std::to_string(place.id)), place);
    }
    for (std::int64_t i = 1; i < 4; i += 2) {
      mapping::GraphNode gateway;
      gateway.id = i;
      gateway.kind = mapping::NodeKind::gateway;
      add(here("node-" + std::to_string(i)), gateway);
      add(mapping::GraphEdge{i - 1, i, 1});
      add(mapping::GraphEdge{i, i + 1, 1});
    }
    put(here("robot-area"), mapping::RobotArea{0, 0, 1});
    on_action<PlannedAction>([this](ActionInProgress&, const PlannedAction& step) {
      if (step.name == "move") {
        const auto area = std::stoll(step.arguments.at(1).substr(std::string("area-").size()));
        put(here("robot-area"), mapping::RobotArea{2 * area, area, 2});
      }
      return ActionResult::succeeded();
    });
  }
};

CASTOR_COMPONENT(DrivenMap, "has a map of three rooms")

/// Wants one goal.
class Wisher final : public UnmanagedComponent {
  void run() override {
    Action end;
    do
      end = perform("planning", AchieveGoal{goal_}).wait(1min);
    // Nothing is known of things before they are bound.
    while (end.outcome != ActionOutcome::succeeded && now() < 50s && sleep_for(10ms));
    add(here("reached"), Reached{end.outcome, end.reason});
  }

  Option<std::string> goal_{this, "goal", "", "the goal"};
};

CASTOR_COMPONENT(Wisher, "wants a goal to be reached")

const std::string sa = "CPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n";

/// Ends in the subarchitecture of binding.
std::string table() {
  return "SUBARCHITECTURE vision\n" + sa + "CPP UM table SeenTable\nSUBARCHITECTURE binding\n" +
         sa +
         "CPP UM ontology OntologySource --files general.ontology\n"
         "CPP UM scorer BindingScorer\nCPP UM judge BindingJudge\nCPP UM binder Binder\n"
         "CPP UM references ReferenceResolver\n";
}

std::string planning(const std::string& domain, const std::string& continual,
                     const std::string& goal) {
  return "SUBARCHITECTURE planning\n" + sa +
         "CPP MG symbolic SymbolicPlanner --domain " CASTOR_DOMAINS "/" + domain +
         "\nCPP MG continual ContinualPlanner " + continual + "\nSUBARCHITECTURE wishes\n" + sa +
         "CPP UM wisher Wisher --goal \"" + goal + "\"\n";
}

Reached reached(TestSystem& system) {
  return *system.expect_entry("Reached in wishes", 1min)->value.as<Reached>();
}

TEST(ContributorsSystem, WhatIsBoundIsPlannedFor) {
  TestSystem system{
    "HOST localhost\n" + table() +
    "CPP MG facts UnionContributor --agent arm --free-places 1 --relations left=wp-left-of\n" +
    planning("playmate.pddl", "--agent arm --contributors binding,vision --executor vision",
             "(left-of box ball)") +
    "ACCESS vision WRITES binding\n"};
  const auto end = reached(system);
  EXPECT_EQ(end.outcome, ActionOutcome::succeeded) << end.reason;
  const auto state = *system.expect_entry("PlanningState in planning")->value.as<PlanningState>();
  EXPECT_THAT(state.facts, Contains("(wp-left-of place^20of^20box ball)"));
  system.expect_nobody_else_down();
}

TEST(ContributorsSystem, WhatIsNotKnownOfThingsOccasionsQuestions) {
  const castor::test::TemporaryFolder folder;
  const auto motives = (folder / "ask.motives").string();
  std::ofstream{motives} << "motive ask\n  when (no-colour ?thing)\n"
                            "  goal (K arm (colour-of {thing}))\n"
                            "  words ask what colour the {thing} is\n  resources voice\n";
  TestSystem system{"HOST localhost\n" + table() +
                    "CPP MG facts UnionContributor --unknown colour=no-colour\n"
                    "SUBARCHITECTURE motivation\n" +
                    sa + "CPP MG motives FactMotives --contributors binding --motives " + motives +
                    " --period 10ms\nACCESS vision WRITES binding\n"};
  const auto ask = *system.expect_entry("Motive in motivation", 30s)->value.as<Motive>();
  EXPECT_EQ(ask.kind, "ask");
  EXPECT_EQ(ask.goal.goal, "(K arm (colour-of box))");
  EXPECT_EQ(ask.words, "ask what colour the box is");
  system.expect_nobody_else_down();
}

TEST(ContributorsSystem, TheRobotGoesThroughTheAreasOfItsMap) {
  TestSystem system{"HOST localhost\nSUBARCHITECTURE mapping\n" + sa +
                    "CPP MG map DrivenMap\nCPP MG facts GraphContributor --agent robby\n" +
                    planning("explorer.pddl",
                             "--agent robby --contributors mapping --executor "
                             "mapping",
                             "(= (is-in robby) area-2)")};
  const auto end = reached(system);
  EXPECT_EQ(end.outcome, ActionOutcome::succeeded) << end.reason;
  const auto planned =
    *system.expect_entry("ContinualPlanning in planning")->value.as<ContinualPlanning>();
  EXPECT_THAT(planned.done,
              testing::ElementsAre("move robby area-1 area-0", "move robby area-2 area-1"));
  const auto state = *system.expect_entry("PlanningState in planning")->value.as<PlanningState>();
  EXPECT_THAT(state.facts, Contains("(= (area-of kitchen) area-2)"));
}

} // namespace

} // namespace castor::planning::contributors_test
