// The PlayMate with an arm: actions move things, which vision then sees elsewhere.

#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/tests/playmate/playmate.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using namespace manipulation;
using testing::HasSubstr;

/// What the requester of a test has asked for, and what it was told.
struct Told {
  Action first;
  Action second;
  Action third;
  ArmState stopped;
  /// How far the joints have gone after they had stopped, radians.
  double went_on = 0;
  double moved_in_pause = 0;
  ArmStatus truth;
  /// Where vision sees it in the end.
  geometry::Point3 seen;
  std::atomic<bool> is_over = false;
};

Told& told() {
  static Told instance;
  return instance;
}

/// Knows the things that vision sees by their colours.
class Asks : public UnmanagedComponent {
protected:
  virtual void ask() = 0;

  /// Waits until vision has seen it.
  EntryPointer<vision::SceneObject> thing(const std::string& colour) {
    while (is_running()) {
      for (const auto& x : read_all_in<vision::SceneObject>("vision"))
        if (x->colour.value == colour)
          return EntryPointer<vision::SceneObject>{x.address};
      sleep_for(200ms);
    }
    return {};
  }

  /// Waits for the end of an action whose executor is ended, and takes the arm home.
  void outlive(ActionHandle& action) {
    told().first = action.wait(60s);
    // Its successor takes it home by itself.
    sleep_for(15s);
    told().second = perform("manipulation", GoHome{}).wait(60s);
  }

  PickAndPlace put(const std::string& colour, double x, double y) {
    PickAndPlace result;
    result.what = thing(colour);
    result.to.x = x;
    result.to.y = y;
    return result;
  }

private:
  void run() override {
    ask();
    told().truth = *pull<ArmStatus>("arm");
    told().is_over = true;
  }
};

class OneMover final : public Asks {
  void ask() override { told().first = perform("manipulation", put("blue", 0.1, -0.1)).wait(120s); }
};
CASTOR_COMPONENT(OneMover, "has a thing put elsewhere")

class TwoMovers final : public Asks {
  void ask() override {
    Pick pick;
    pick.what = thing("blue");
    told().first = perform("manipulation", pick).wait(120s);
    told().second = perform("manipulation", pick).wait(120s);
    Place place;
    place.to.x = 0.05;
    place.to.y = -0.15;
    told().third = perform("manipulation", place).wait(120s);
  }
};
CASTOR_COMPONENT(TwoMovers, "has a thing taken, and put down")

/// Stops an action under way, pauses another.
class Stopper final : public Asks {
  void ask() override {
    auto action = perform("manipulation", put("blue", 0.1, -0.1));
    while (is_running() && !pull<ArmState>("arm")->holds)
      sleep_for(100ms);
    const auto stop = perform("manipulation", StopArm{}).wait(10s);
    told().stopped = *pull<ArmState>("arm");
    told().first = action.wait(5s);
    sleep_for(500ms);
    const auto later = *pull<ArmState>("arm");
    told().stopped.rests = stop.outcome == ActionOutcome::succeeded;
    told().went_on = manipulation::distance(later.positions, told().stopped.positions);
    // The same again, from where it stands, with a pause.
    auto second = perform("manipulation", put("blue", 0.1, -0.1));
    sleep_for(3s);
    second.pause();
    sleep_for(2s);
    const auto before = *pull<ArmState>("arm");
    sleep_for(3s);
    told().moved_in_pause =
      manipulation::distance(pull<ArmState>("arm")->positions, before.positions);
    second.resume();
    told().second = second.wait(120s);
  }
};
CASTOR_COMPONENT(Stopper, "stops and pauses the arm")

class HomeGoer final : public Asks {
  void ask() override {
    auto action = perform("manipulation", put("blue", 0.1, -0.1));
    while (is_running() && !pull<ArmState>("arm")->holds)
      sleep_for(100ms);
    told().stopped = *pull<ArmState>("arm");
    told().is_over = true;
    outlive(action);
    told().stopped = *pull<ArmState>("arm");
    add(Manipulation{});
  }
};
CASTOR_COMPONENT(HomeGoer, "sees the executor fail")

/// Has the arm stand when it has let the ball go, and vision has not seen it there.
class Releaser final : public Asks {
  void ask() override {
    auto action = perform("manipulation", put("blue", 0.1, -0.1));
    while (is_running() && !is_let_go())
      sleep_for(20ms);
    action.pause();
    sleep_for(2s);
    told().stopped = *pull<ArmState>("arm");
    told().is_over = true;
    outlive(action);
    sleep_for(10s);
    told().stopped = *pull<ArmState>("arm");
    told().seen = read<vision::SceneObject>(thing("blue").address)->box.centroid;
    told().truth = *pull<ArmStatus>("arm");
    add(Manipulation{});
  }

  bool is_let_go() {
    const auto grasped = read_all_in<HeldThing>("manipulation", 1);
    return !grasped.empty() && grasped.front()->let_go;
  }
};
CASTOR_COMPONENT(Releaser, "sees the executor fail when it has let a thing go")

class Taker final : public Asks {
  void ask() override {
    Pick pick;
    pick.what = thing("blue");
    told().first = perform("manipulation", pick).wait(120s);
    told().is_over = true;
    sleep_for(60s);
    for (const auto& x : read_all_in<vision::SceneObject>("vision"))
      if (x->colour.value == "blue")
        told().seen = x->box.centroid;
  }
};
CASTOR_COMPONENT(Taker, "holds a thing that is forgotten")

class PlayMateWithArm : public testing::Test {
protected:
  std::unique_ptr<TestSystem> system_with(const std::string& asker,
                                          std::map<std::string, std::string> variables = {}) {
    told().first = told().second = told().third = {};
    told().stopped = {};
    told().seen = {};
    told().is_over = false;
    variables["arm"] = "true";
    auto options = playmate_options(std::move(variables));
    options.patience = 400s;
    return std::make_unique<TestSystem>(with_patience(playmate_cast()) +
                                          "SUBARCHITECTURE asking\n"
                                          "CPP WM SubarchitectureWorkingMemory\n"
                                          "CPP TM AlwaysPositiveTaskManager\n"
                                          "CPP UM asker " +
                                          asker + "\n",
                                        options);
  }

  void run(const std::string& asker, std::map<std::string, std::string> variables = {}) {
    system_ = system_with(asker, std::move(variables));
    system_->wait_until("all was asked for", [] { return told().is_over.load(); });
  }

  static TrueThing truth(const std::string& name) {
    const auto found = std::ranges::find(told().truth.things, name, &TrueThing::name);
    return found == told().truth.things.end() ? TrueThing{} : *found;
  }

  std::unique_ptr<TestSystem> system_;
};

TEST_F(PlayMateWithArm, PutsAThingWhereVisionThenSeesIt) {
  TemporaryFolder folder;
  run("OneMover", {{"output", folder.path().string()}});
  ASSERT_EQ(told().first.outcome, ActionOutcome::succeeded) << told().first.reason;
  ASSERT_EQ(told().first.became_true.size(), 1u);
  const auto& seen = told().first.became_true.front();
  ASSERT_TRUE(seen.starts_with("seen vision/")) << seen;
  std::optional<vision::SceneObject> object;
  int objects = 0;
  for (const auto& entry : system_->system().entries("vision"))
    if (const auto x = entry->value.as<vision::SceneObject>()) {
      ++objects;
      if ("seen vision/" + entry->address.id == seen)
        object = *x;
    }
  EXPECT_EQ(objects, 5);
  ASSERT_TRUE(object);
  EXPECT_EQ(object->colour.value, "blue");
  EXPECT_NEAR(object->box.centroid.x, 0.1, 0.035);
  EXPECT_NEAR(object->box.centroid.y, -0.1, 0.035);
  const auto ball = truth("the blue sphere");
  EXPECT_NEAR(ball.pose.position.x, 0.1, 0.02);
  EXPECT_NEAR(ball.pose.position.y, -0.1, 0.02);
  EXPECT_EQ(ball.support, "the table");
  EXPECT_EQ(told().truth.collisions, 0) << told().truth.collision;
  EXPECT_NEAR(truth("the green cube").pose.position.x, 0.20, 1e-6);
  system_->wait_until("there is a film strip",
                      [&] { return std::filesystem::exists(folder.path() / "action-1.png"); });
  system_->expect_nobody_else_down();
}

TEST_F(PlayMateWithArm, TakesAThingAndPutsItDownLater) {
  run("TwoMovers");
  EXPECT_EQ(told().first.outcome, ActionOutcome::succeeded) << told().first.reason;
  EXPECT_EQ(told().second.outcome, ActionOutcome::failed);
  EXPECT_THAT(told().second.reason, HasSubstr("already holds the blue sphere"));
  EXPECT_EQ(told().third.outcome, ActionOutcome::succeeded) << told().third.reason;
  EXPECT_NEAR(truth("the blue sphere").pose.position.x, 0.05, 0.02);
  EXPECT_NEAR(truth("the blue sphere").pose.position.y, -0.15, 0.02);
  EXPECT_EQ(told().truth.collisions, 0) << told().truth.collision;
}

TEST_F(PlayMateWithArm, GivesUpWhenItsFingersAlwaysSlipOff) {
  run("OneMover", {{"missed_grasp", "1"}});
  EXPECT_EQ(told().first.outcome, ActionOutcome::failed);
  EXPECT_EQ(told().first.reason, "it slipped out of the gripper");
  EXPECT_EQ(told().truth.missed, 3);
  EXPECT_EQ(told().truth.collisions, 0) << told().truth.collision;
}

TEST_F(PlayMateWithArm, GoesOnWithoutAJointThatDoesNotMoveAnyMore) {
  run("OneMover", {{"sticking_joint", "roll"}, {"sticks_after", "5500ms"}});
  EXPECT_EQ(told().first.outcome, ActionOutcome::succeeded) << told().first.reason;
  EXPECT_NEAR(truth("the blue sphere").pose.position.x, 0.1, 0.02);
  EXPECT_EQ(truth("the blue sphere").support, "the table");
  EXPECT_EQ(told().truth.collisions, 0) << told().truth.collision;
}

TEST_F(PlayMateWithArm, StopsAndPausesAndGoesOn) {
  run("Stopper");
  EXPECT_EQ(told().first.outcome, ActionOutcome::cancelled);
  EXPECT_TRUE(told().stopped.rests);
  // Joints count as resting while they still catch up by less than 1e-3 rad/s.
  EXPECT_LT(told().went_on, 1e-3) << "it moved after the stop";
  EXPECT_LT(told().moved_in_pause, 1e-5) << "it moved during the pause";
  EXPECT_EQ(told().second.outcome, ActionOutcome::succeeded) << told().second.reason;
  EXPECT_NEAR(truth("the blue sphere").pose.position.x, 0.1, 0.02);
  EXPECT_EQ(told().truth.collisions, 0) << told().truth.collision;
}

TEST_F(PlayMateWithArm, ComesToRestWhenItsExecutorFailsAndIsTakenHome) {
  system_ = system_with("HomeGoer");
  system_->wait_until("the gripper holds the ball", [] { return told().is_over.load(); });
  system_->inject("crash executor");
  system_->expect_back("executor");
  system_->expect_entry("Manipulation in asking");
  EXPECT_EQ(told().first.outcome, ActionOutcome::failed);
  EXPECT_EQ(told().second.outcome, ActionOutcome::succeeded) << told().second.reason;
  EXPECT_TRUE(told().stopped.rests);
}

TEST_F(PlayMateWithArm, DrawsBackFromWhatAPredecessorHasLetGo) {
  system_ = system_with("Releaser");
  system_->wait_until("the ball was let go", [] { return told().is_over.load(); });
  // The fingers are still around it.
  EXPECT_FALSE(told().stopped.holds);
  const auto arm = load_arm(CASTOR_CONFIGS "/arms/katana.arm").arm;
  const auto tool = tool_pose(arm, told().stopped.positions).position;
  EXPECT_LT(tool.z, 0.1);
  system_->inject("crash executor");
  system_->expect_back("executor");
  system_->expect_entry("Manipulation in asking");
  EXPECT_EQ(told().first.outcome, ActionOutcome::failed);
  EXPECT_EQ(told().second.outcome, ActionOutcome::succeeded) << told().second.reason;
  EXPECT_TRUE(told().stopped.rests);
  const auto ball = truth("the blue sphere");
  EXPECT_NEAR(ball.pose.position.x, 0.1, 0.02);
  EXPECT_NEAR(ball.pose.position.y, -0.1, 0.02);
  EXPECT_NEAR(told().seen.x, ball.pose.position.x, 0.02);
  EXPECT_NEAR(told().seen.y, ball.pose.position.y, 0.02);
  EXPECT_EQ(told().truth.collisions, 0) << told().truth.collision;
}

TEST_F(PlayMateWithArm, PutsDownWhereItSeesItWhatNobodyKnowsAnyMore) {
  system_ = system_with("Taker");
  system_->wait_until("the gripper holds the ball", [] { return told().is_over.load(); });
  ASSERT_EQ(told().first.outcome, ActionOutcome::succeeded) << told().first.reason;
  told().is_over = false;
  // Without a journal it comes back empty.
  system_->inject("crash manipulation_wm");
  system_->wait_until("a minute is over", [] { return told().is_over.load(); });
  const auto ball = truth("the blue sphere");
  EXPECT_EQ(ball.support, "the table");
  EXPECT_NEAR(told().seen.x, ball.pose.position.x, 0.02);
  EXPECT_NEAR(told().seen.y, ball.pose.position.y, 0.02);
  EXPECT_EQ(told().truth.collisions, 0) << told().truth.collision;
}

} // namespace

} // namespace castor::test
