// The Explorer's classic story on a pretended body: nobody has told the robot where the book is; it
// plans with a promise, a human says where the book is, the promise is replaced, and the book
// found. And what comes of it when steps fail, the world changes, and components end.

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace castor::planning::test {

/// What is so, and what the body's subarchitectures have found out of it.
struct PretendedWorld {
  std::string robby = "hall";
  std::string ann = "study";
  std::string book = "kitchen";
  std::string said;
  std::string seen;
  bool ann_knows = false;
  /// Steps that were executed to their end.
  std::vector<std::string> log;
};
CASTOR_REFLECT(PretendedWorld, robby, ann, book, said, seen, ann_knows, log)

/// How the goal ended.
struct GoalEnded {
  ActionOutcome outcome = ActionOutcome::none;
  std::string reason;
};
CASTOR_REFLECT(GoalEnded, outcome, reason)

namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Executes each step in a second, and knows what it has seen and heard.
class PretendedBody final : public ManagedComponent {
  void start() override {
    if (!exists(world_)) {
      PretendedWorld world;
      world.book = book_;
      add(world_, world);
    }
    if (!silent_)
      on_call<StateRequest>(
        [this](const StateRequest&) { return tell(*read<PretendedWorld>(world_)); });
    on_action<PlannedAction>([this](ActionInProgress& action, const PlannedAction& step) {
      return execute(action, step);
    });
  }

  static StateReply tell(const PretendedWorld& world) {
    StateReply result;
    result.objects = {{"robby", "robot"}, {"ann", "human"},    {"hall", "room"},
                      {"study", "room"},  {"kitchen", "room"}, {"book", "thing"}};
    result.facts = {"(= (is-in robby) " + world.robby + ")",
                    "(= (is-in ann) " + world.ann + ")",
                    "(connected hall study)",
                    "(connected study hall)",
                    "(connected hall kitchen)",
                    "(connected kitchen hall)",
                    "(K ann (asserted-position book))"};
    if (!world.said.empty())
      result.facts.push_back("(= (asserted-position book) " + world.said + ")");
    if (!world.seen.empty())
      result.facts.push_back("(= (perceived-position book) " + world.seen + ")");
    if (world.ann_knows)
      result.facts.emplace_back("(K ann (perceived-position book))");
    return result;
  }

  ActionResult execute(ActionInProgress& action, const PlannedAction& step) {
    if (!action.sleep_for(step_.get()))
      return ActionResult::cancelled("the robot stands still");
    const auto fails = fails_.get();
    const auto times = std::ranges::count(fails, step.name);
    if (failed_[step.name]++ < times)
      return ActionResult::failed("injected");
    auto world = *read<PretendedWorld>(world_);
    if (step.name == "move")
      world.robby = step.arguments.at(1);
    else if (step.name == "ask-val-asserted-position")
      world.said = "kitchen";
    else if (step.name == "object-search-in-room")
      world.seen = world.book == step.arguments.at(2) ? world.book : "";
    else if (step.name == "inform")
      world.ann_knows = true;
    else
      return ActionResult::failed("the body does not know how to " + step.name);
    std::string text = step.name;
    for (const auto& x : step.arguments)
      text += ' ' + x;
    world.log.push_back(text);
    // Ann goes to the kitchen once the robot has come to the study, if she is restless.
    if (restless_ && world.log.size() == 1)
      world.ann = "kitchen";
    put(world_, world);
    return ActionResult::succeeded();
  }

  Option<std::string> book_{this, "book", "kitchen", "where the book is"};
  Option<std::vector<std::string>> fails_{
    this, "fails", {}, "actions that fail, as often as named"};
  Option<bool> restless_{this, "restless", false, "Ann leaves when the robot comes"};
  Option<std::chrono::milliseconds> step_{this, "step", 1s, "how long each step takes"};
  Option<bool> silent_{this, "silent", false, "never answers what it knows"};

  const Address world_{"body", "world"};
  std::map<std::string, int> failed_;
};

CASTOR_COMPONENT(PretendedBody, "moves in three rooms, asks and searches")

/// Wants one goal to be reached.
class GoalOwner final : public UnmanagedComponent {
  void run() override {
    auto action = perform("planning", AchieveGoal{goal_});
    if (!then_->empty()) {
      sleep_for(500ms);
      overwrite(action.state().what.address, AchieveGoal{then_});
    }
    if (cancel_after_.get() > 0ms) {
      sleep_for(cancel_after_.get());
      action.cancel();
    }
    const auto end = action.wait(10min);
    add(here("end"), GoalEnded{end.outcome, end.reason});
  }

  Option<std::string> goal_{this, "goal", "(K robby (perceived-position book))", "the goal"};
  Option<std::string> then_{this, "then", "", "another goal, after half a second; empty for none"};
  Option<std::chrono::milliseconds> cancel_after_{this, "cancel-after", 0ms, "0 for never"};
};

CASTOR_COMPONENT(GoalOwner, "wants a goal to be reached")

struct StoryOptions {
  std::string body = {};
  std::string owner = {};
  std::string continual = {};
  bool is_simulated = true;
  std::string faults = {};
};

std::string story(const StoryOptions& options) {
  const std::string sa = "CPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n";
  return "HOST localhost\nSUBARCHITECTURE body\n" + sa + "CPP MG body PretendedBody " +
         options.body + "\nSUBARCHITECTURE planning\n" + sa +
         "CPP MG planner SymbolicPlanner --domain " CASTOR_DOMAINS "/explorer.pddl\n"
         "CPP MG continual ContinualPlanner --agent robby --contributors body --executor body " +
         options.continual + "\nSUBARCHITECTURE owner\n" + sa + "CPP UM owner GoalOwner " +
         options.owner + "\nSUPERVISE * RESTARTS 1000 IN 10s\n";
}

class ExplorerStory {
public:
  explicit ExplorerStory(const StoryOptions& options = {})
    : system_(story(options), {.patience = 1min,
                               .faults = options.faults,
                               .simulated_time = options.is_simulated}) {
    // nop
  }

  TestSystem& system() { return system_; }

  GoalEnded end() { return *system_.expect_entry("GoalEnded in owner")->value.as<GoalEnded>(); }
  ContinualPlanning planning() {
    return *system_.expect_entry("ContinualPlanning in planning")->value.as<ContinualPlanning>();
  }
  PlanningState state() {
    return *system_.expect_entry("PlanningState in planning")->value.as<PlanningState>();
  }
  PretendedWorld world() {
    return *system_.expect_entry("PretendedWorld in body")->value.as<PretendedWorld>();
  }

private:
  TestSystem system_;
};

/// In real time, so that components can be ended in the middle of something.
ExplorerStory real_story(const std::string& faults = {}) {
  return ExplorerStory({.body = "--step 50ms", .is_simulated = false, .faults = faults});
}

const std::vector<std::string> whole_story{
  "move robby study hall", "ask-val-asserted-position robby ann book study",
  "move robby hall study", "move robby kitchen hall", "object-search-in-room robby book kitchen"};

std::vector<PlanReason> reasons_of(const ContinualPlanning& x) {
  std::vector<PlanReason> result;
  for (const auto& plan : x.plans)
    result.push_back(plan.reason);
  return result;
}

TEST(ExplorerStory, ReplacesThePromiseOnceAHumanHasSaidWhereTheBookIs) {
  ExplorerStory story;
  const auto end = story.end();
  EXPECT_EQ(end.outcome, ActionOutcome::succeeded) << end.reason;
  const auto planning = story.planning();
  EXPECT_EQ(planning.phase, PlanPhase::achieved);
  EXPECT_EQ(planning.done, whole_story);
  EXPECT_EQ(story.world().log, whole_story);
  EXPECT_THAT(planning.steps, IsEmpty());
  ASSERT_EQ(planning.plans.size(), 2U);
  EXPECT_EQ(planning.plans[0].reason, PlanReason::no_plan_yet);
  ASSERT_EQ(planning.plans[0].steps.size(), 3U);
  EXPECT_EQ(planning.plans[0].steps[2],
            (PlannedStep{"object-search-in-room_a robby book", StepKind::assertion, 1}));
  EXPECT_EQ(planning.plans[1].reason, PlanReason::assertion_enabled);
  EXPECT_EQ(planning.plans[1].why, "what 'object-search-in-room_a robby book' waits for is known");
  ASSERT_EQ(planning.plans[1].steps.size(), 3U);
  EXPECT_EQ(planning.plans[1].steps[2].kind, StepKind::sensor);
  EXPECT_THAT(story.state().became_true, ElementsAre("(= (perceived-position book) kitchen)"));
  EXPECT_EQ(planning.state.address.subarchitecture, "planning");
}

TEST(ExplorerStory, GoesOnToTellWhoAskedForIt) {
  ExplorerStory story({.owner = "--goal \"(K ann (perceived-position book))\""});
  EXPECT_EQ(story.end().outcome, ActionOutcome::succeeded);
  auto wanted = whole_story;
  wanted.insert(wanted.end(), {"move robby hall kitchen", "move robby study hall",
                               "inform robby ann book study kitchen"});
  EXPECT_EQ(story.world().log, wanted);
  EXPECT_EQ(reasons_of(story.planning()).back(), PlanReason::assertion_enabled);
}

TEST(ExplorerStory, TriesAgainWhatFailed) {
  ExplorerStory story({.body = "--fails move,move,ask-val-asserted-position"});
  EXPECT_EQ(story.end().outcome, ActionOutcome::succeeded);
  EXPECT_EQ(story.world().log, whole_story);
  EXPECT_THAT(reasons_of(story.planning()),
              ElementsAre(PlanReason::no_plan_yet, PlanReason::action_failed,
                          PlanReason::action_failed, PlanReason::action_failed,
                          PlanReason::assertion_enabled));
}

TEST(ExplorerStory, GivesUpWhatAlwaysFails) {
  ExplorerStory story({.body = "--fails move,move,move,move,move,move,move,move"});
  const auto end = story.end();
  EXPECT_EQ(end.outcome, ActionOutcome::failed);
  EXPECT_THAT(end.reason, HasSubstr("5 times in a row"));
  EXPECT_THAT(end.reason, HasSubstr("'move robby study hall' failed: injected"));
  EXPECT_EQ(story.planning().phase, PlanPhase::given_up);
}

TEST(ExplorerStory, FollowsTheHumanWhoHasGone) {
  ExplorerStory story({.body = "--restless true"});
  EXPECT_EQ(story.end().outcome, ActionOutcome::succeeded);
  const auto planning = story.planning();
  ASSERT_GE(planning.plans.size(), 2U);
  EXPECT_EQ(planning.plans[1].reason, PlanReason::state_changed);
  EXPECT_THAT(planning.plans[1].why, HasSubstr("ask-val-asserted-position robby ann book study"));
  EXPECT_THAT(planning.done, testing::Contains("ask-val-asserted-position robby ann book kitchen"));
}

TEST(ExplorerStory, SaysThatTheBookIsNotWhereItWasSaidToBe) {
  ExplorerStory story({.body = "--book study"});
  const auto end = story.end();
  EXPECT_EQ(end.outcome, ActionOutcome::failed);
  EXPECT_THAT(end.reason, HasSubstr("there is no plan"));
  EXPECT_EQ(story.planning().done, whole_story) << "it was searched for once";
}

TEST(ExplorerStory, EndsTheStepThatRunsWhenTheGoalIsCancelled) {
  ExplorerStory story({.owner = "--cancel-after 1500ms"});
  const auto end = story.end();
  EXPECT_EQ(end.outcome, ActionOutcome::cancelled);
  EXPECT_THAT(end.reason, HasSubstr("the robot stands still"));
  EXPECT_THAT(story.world().log, ElementsAre(whole_story.front()));
  EXPECT_EQ(story.planning().phase, PlanPhase::cancelled);
}

TEST(ExplorerStory, FollowsAGoalThatIsChangedDuringAStep) {
  ExplorerStory story({.owner = "--then \"(= (is-in robby) kitchen)\""});
  EXPECT_EQ(story.end().outcome, ActionOutcome::succeeded);
  EXPECT_THAT(story.world().log, ElementsAre("move robby study hall", "move robby hall study",
                                             "move robby kitchen hall"));
  EXPECT_THAT(reasons_of(story.planning()),
              ElementsAre(PlanReason::no_plan_yet, PlanReason::goal_changed));
  EXPECT_EQ(story.planning().goal, "(= (is-in robby) kitchen)");
}

TEST(ExplorerStory, GivesUpIfAContributorNeverAnswers) {
  // Time limits of calls are real time.
  ExplorerStory story(
    {.body = "--silent true", .continual = "--patience 100ms", .is_simulated = false});
  const auto end = story.end();
  EXPECT_EQ(end.outcome, ActionOutcome::failed);
  EXPECT_THAT(end.reason, HasSubstr("body did not say what it knows"));
}

/// Runs of each test that ends a component; 100 for the figures of the docs.
int runs() {
  const auto* text = std::getenv("CASTOR_STORY_RUNS");
  return text ? std::atoi(text) : 2;
}

const std::string while_acting =
  "overwritten ContinualPlanning in planning where phase == \"acting\"";

void expect_goal_reached_without(const std::string& component, const std::string& when) {
  for (int i = 0; i < runs(); ++i) {
    auto story = real_story("after " + when + ": crash " + component);
    story.system().expect_down(component);
    const auto end = story.end();
    EXPECT_EQ(end.outcome, ActionOutcome::succeeded) << end.reason;
    EXPECT_EQ(story.planning().phase, PlanPhase::achieved);
    EXPECT_EQ(story.world().log.back(), whole_story.back());
    story.system().expect_nobody_else_down({component});
  }
}

TEST(ExplorerStory, ReachesTheGoalThoughThePlannerEnds) {
  expect_goal_reached_without("planner", "added FindPlan in planning");
}

TEST(ExplorerStory, ReachesTheGoalThoughTheExecutorEnds) {
  expect_goal_reached_without("body", while_acting);
}

TEST(ExplorerStory, FailsInWordsIfTheExecutorOfGoalsEnds) {
  for (int i = 0; i < runs(); ++i) {
    auto story = real_story("after " + while_acting + ": crash continual");
    const auto end = story.end();
    EXPECT_EQ(end.outcome, ActionOutcome::failed);
    EXPECT_THAT(end.reason, HasSubstr("continual of planning ended"));
  }
}

} // namespace

} // namespace castor::planning::test
