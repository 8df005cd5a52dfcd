// People ask the PlayMate with an arm to do something: it does it, sees that it is so, and says so.

#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/types.hpp"
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
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using namespace manipulation;

/// What the listener of a test waits for, and how the table was when it was said.
struct Heard {
  std::string last;
  ArmStatus truth;
  std::atomic<bool> is_over = false;
};

Heard& heard() {
  static Heard instance;
  return instance;
}

class TableListener final : public UnmanagedComponent {
  void run() override {
    while (is_running()) {
      for (const auto& x : read_all_in<communication::SpokenOutputItem>("communication"))
        if (!heard().is_over && x->text.find(heard().last) != std::string::npos) {
          heard().truth = *pull<ArmStatus>("arm");
          heard().is_over = true;
        }
      sleep_for(500ms);
    }
  }
};
CASTOR_COMPONENT(TableListener, "waits until the robot says something")

class PlayMateIsAsked : public testing::Test {
protected:
  /// @param last words with which the test ends
  void say(const std::string& text, const std::string& last,
           std::map<std::string, std::string> variables = {}) {
    heard().last = last;
    heard().truth = {};
    heard().is_over = false;
    variables["arm"] = "true";
    variables["say"] = text;
    auto options = playmate_options(std::move(variables));
    options.patience = 600s;
    system_ = std::make_unique<TestSystem>(playmate_cast() + "SUBARCHITECTURE listening\n"
                                                             "CPP WM SubarchitectureWorkingMemory\n"
                                                             "CPP TM AlwaysPositiveTaskManager\n"
                                                             "CPP UM listener TableListener\n",
                                           options);
    try {
      system_->wait_until(last, [] { return heard().is_over.load(); });
    } catch (const ExpectationFailed&) {
      EXPECT_THAT(said(), testing::Contains(testing::HasSubstr(last)));
    }
  }

  std::vector<std::string> said() const {
    std::vector<std::string> result;
    for (const auto& entry : system_->system().entries("communication"))
      if (const auto x = entry->value.as<communication::SpokenOutputItem>())
        result.push_back(x->text);
    return result;
  }

  static geometry::Point3 place(const std::string& name) {
    const auto& things = heard().truth.things;
    const auto found = std::ranges::find(things, name, &TrueThing::name);
    return found == things.end() ? geometry::Point3{} : found->pose.position;
  }

  std::unique_ptr<TestSystem> system_;
};

TEST_F(PlayMateIsAsked, ToPutAThingBesideAnother) {
  TemporaryFolder folder;
  say("Put the blue ball to the right of the red cube.", "now.",
      {{"output", folder.path().string()}});
  EXPECT_THAT(said(), testing::Contains("The blue ball is to the right of the red cube now."));
  const auto ball = place("the blue sphere");
  const auto cube = place("the red cube");
  EXPECT_GT(ball.x, cube.x + 0.05);
  // Half a right angle to each side.
  EXPECT_LT(std::abs(ball.y - cube.y), ball.x - cube.x);
  EXPECT_EQ(heard().truth.collisions, 0) << heard().truth.collision;
  system_->wait_until("there is a film strip",
                      [&] { return std::filesystem::exists(folder.path() / "action-1.png"); });
  system_->expect_nobody_else_down();
}

TEST_F(PlayMateIsAsked, ToSwapTwoThings) {
  say("Swap the red cube and the blue ball.", "have changed places");
  const auto ball = place("the blue sphere");
  const auto cube = place("the red cube");
  EXPECT_LT(std::hypot(ball.x - 0.02, ball.y + 0.02), 0.04);
  EXPECT_LT(std::hypot(cube.x + 0.16, cube.y + 0.09), 0.04);
  EXPECT_EQ(heard().truth.collisions, 0) << heard().truth.collision;
}

TEST_F(PlayMateIsAsked, ToGiveAThing) {
  say("Give me the green cube.", "ere you are");
  // Nearer to who sits in front.
  EXPECT_LT(place("the green cube").y, -0.06 - 0.03);
  EXPECT_EQ(heard().truth.collisions, 0) << heard().truth.collision;
}

TEST_F(PlayMateIsAsked, ToPutDownWhatItHolds) {
  say("Take the blue ball. Put it down.", "have put down");
  EXPECT_THAT(said(), testing::Contains("I have put down the blue ball."));
  const auto& things = heard().truth.things;
  const auto ball = std::ranges::find(things, "the blue sphere", &TrueThing::name);
  ASSERT_NE(ball, things.end());
  EXPECT_EQ(ball->support, "the table");
}

TEST_F(PlayMateIsAsked, WhatItDoesAndWhy) {
  say("Put the blue ball to the right of the red cube. What are you doing?", "because");
  EXPECT_THAT(said(), testing::Contains(testing::HasSubstr(
                        "because you said 'Put the blue ball to the right of the red cube'")));
}

TEST_F(PlayMateIsAsked, AndSaysWhyItCannot) {
  say("Put the blue ball to the right of the red cube.", "I cannot", {{"missed_grasp", "1"}});
  EXPECT_THAT(said(), testing::Contains(testing::StartsWith(
                        "I cannot put the blue ball to the right of the red cube: ")));
  EXPECT_GT(heard().truth.missed, 0);
  EXPECT_EQ(heard().truth.collisions, 0) << heard().truth.collision;
}

} // namespace

} // namespace castor::test
