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
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using namespace manipulation;

/// In place of what is said: when the gripper holds something.
constexpr auto when_it_holds = "(the gripper holds something)";

/// What the listener of a test waits for, and how the table was when it was said.
struct Heard {
  std::string last;
  /// What is said when words were heard: "I hold", then "What are you holding?".
  std::vector<std::pair<std::string, std::string>> replies;
  ArmStatus truth;
  std::atomic<bool> is_over = false;
};

Heard& heard() {
  static Heard instance;
  return instance;
}

class TableListener final : public UnmanagedComponent {
  void run() override {
    std::size_t replied = 0;
    while (is_running()) {
      const auto& replies = heard().replies;
      if (replied < replies.size() && is_said(replies[replied].first))
        say(replies[replied++].second);
      else if (replied == replies.size() && !heard().is_over && is_said(heard().last)) {
        heard().truth = *pull<ArmStatus>("arm");
        heard().is_over = true;
      }
      sleep_for(500ms);
    }
  }

  bool is_said(const std::string& words) {
    if (words == when_it_holds)
      return std::ranges::any_of(read_all_in<Manipulation>("manipulation"),
                                 [](const auto& x) { return !x->holds.empty(); });
    return std::ranges::any_of(
      read_all_in<communication::SpokenOutputItem>("communication"),
      [&](const auto& x) { return x->text.find(words) != std::string::npos; });
  }

  void say(const std::string& text) {
    const auto before = read_all_in<communication::PhonString>("communication").size();
    communication::PhonString said;
    said.word_sequence = text;
    said.turn = static_cast<std::int32_t>(before);
    add(Address{"communication", "utterance " + std::to_string(before + 1)}, std::move(said));
  }
};
CASTOR_COMPONENT(TableListener, "waits until the robot says something")

class PlayMateIsAsked : public testing::Test {
protected:
  /// @param last words with which the test ends
  /// @param replies what else is said when words were heard
  void say(const std::string& text, const std::string& last,
           std::map<std::string, std::string> variables = {},
           std::vector<std::pair<std::string, std::string>> replies = {}) {
    heard().last = last;
    heard().replies = std::move(replies);
    heard().truth = {};
    heard().is_over = false;
    variables["arm"] = "true";
    variables["say"] = text;
    auto options = playmate_options(std::move(variables));
    options.patience = 600s;
    system_ = std::make_unique<TestSystem>(with_patience(playmate_cast()) +
                                             "SUBARCHITECTURE listening\n"
                                             "CPP WM SubarchitectureWorkingMemory\n"
                                             "CPP TM AlwaysPositiveTaskManager\n"
                                             "CPP UM listener TableListener\n"
                                             "ACCESS listening WRITES "
                                             "communication\n",
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

TEST_F(PlayMateIsAsked, ToDoSomethingElseInstead) {
  say("Put the blue ball to the right of the red cube. No, in front of it.",
      "in front of the red cube now");
  EXPECT_THAT(said(),
              testing::Not(testing::Contains(testing::HasSubstr("right of the red cube now"))));
  EXPECT_LT(place("the blue sphere").y, place("the red cube").y - 0.05);
}

TEST_F(PlayMateIsAsked, ToTakeSomethingAwayFirst) {
  say("Put the blue ball to the right of the red cube. Take the green cube away first.",
      "right of the red cube now");
  EXPECT_THAT(said(), testing::Contains("The green cube is somewhere else now."));
  EXPECT_GT(std::hypot(place("the green cube").x - 0.20, place("the green cube").y + 0.06), 0.05);
  EXPECT_GT(place("the blue sphere").x, place("the red cube").x + 0.05);
}

TEST_F(PlayMateIsAsked, ToPutAThingWhereAnotherIsAndWas) {
  say("Put the red cube where the green cube is. Put the blue ball where the red cube was.",
      "The blue ball is where the red cube was.");
  EXPECT_LT(std::hypot(place("the red cube").x - 0.20, place("the red cube").y + 0.06), 0.04);
  EXPECT_LT(std::hypot(place("the blue sphere").x - 0.02, place("the blue sphere").y + 0.02), 0.04);
}

TEST_F(PlayMateIsAsked, WhatItHoldsAndToPutThatSomewhere) {
  say("Take the blue ball.", "left edge now", {},
      {{"I hold the blue ball now.", "What are you holding?"},
       {"blue ball.", "Where is the blue ball?"},
       {"gripper", "Put it down at the left edge."}});
  EXPECT_THAT(said(), testing::Contains("It is in the gripper."));
  EXPECT_THAT(said(), testing::Contains("The blue ball is at the left edge now."));
}

TEST_F(PlayMateIsAsked, WhatItHasDoneAndWhy) {
  say("Move the red cube a little to the right.", "that is done", {},
      {{"right now.", "Why did you move the cube?"},
       {"Because", "What did you just do?"},
       {"The last thing", "Are you done?"}});
  EXPECT_THAT(said(),
              testing::Contains("Because you said 'Move the red cube a little to the right'."));
  EXPECT_THAT(said(),
              testing::Contains(testing::StartsWith(
                "The last thing that I did was to put the red cube a little to the right, ")));
  EXPECT_NEAR(place("the red cube").x, 0.06, 0.015);
}

TEST_F(PlayMateIsAsked, ToPutEverythingBack) {
  say("Move the red cube a little to the right.", "are where they were at first", {},
      {{"right now.", "Give me the green cube."}, {"ere you are", "Put everything back."}});
  EXPECT_LT(std::hypot(place("the red cube").x - 0.02, place("the red cube").y + 0.02), 0.04);
  EXPECT_LT(std::hypot(place("the green cube").x - 0.20, place("the green cube").y + 0.06), 0.04);
}

/// Of the cylinder below, the camera sees a rest that looks like a ball.
TEST_F(PlayMateIsAsked, AboutThingsOfATowerAndToTakeItDown) {
  say("Stack the two cubes.", "The yellow cylinder is where it was before.", {},
      {{"on the red cube now.", "Put the cylinder on the green cube."},
       {"on the green cube now.", "What is at the bottom?"},
       {"a small red cube", "How many things are there?"},
       {"five things", "Put the cylinder back."}});
  EXPECT_LT(
    std::hypot(place("the yellow cylinder").x + 0.12, place("the yellow cylinder").y - 0.06), 0.04);
}

TEST_F(PlayMateIsAsked, WhatItHoldsWhileItIsStopped) {
  say("Put the blue ball to the right of the red cube.", "right of the red cube now.", {},
      {{when_it_holds, "Stop!"},
       {"I have stopped.", "What are you holding?"},
       {"It is a small blue ball.", "Where is the blue ball?"},
       {"It is in the gripper.", "Go on."}});
  EXPECT_EQ(heard().truth.collisions, 0) << heard().truth.collision;
}

TEST_F(PlayMateIsAsked, ToPutAThingOnOneThatItHasPutDown) {
  say("Put the red cube next to the yellow cylinder.", "The green cube is on the red cube now.", {},
      {{"next to the yellow cylinder now.", "Put the green cube on the red cube."}});
  EXPECT_EQ(heard().truth.collisions, 0) << heard().truth.collision;
}

TEST_F(PlayMateIsAsked, ForTheOtherOneThanItHasChosen) {
  // Where the red cube is put down is not this test's.
  say("Take a cube.", "The green cube was ", {},
      {{"I hold the red cube now.", "Not that one, the other one."},
       {"I hold the green cube now.", "Where was it before?"}});
  const auto& things = heard().truth.things;
  const auto cube = std::ranges::find(things, "the green cube", &TrueThing::name);
  ASSERT_NE(cube, things.end());
  EXPECT_EQ(cube->support, "the gripper");
}

TEST_F(PlayMateIsAsked, WhileTheArmMoves) {
  say("Put a ball behind the red cube.", "ere you are: the yellow cylinder", {},
      {{"I will put the purple ball", "No, the other one."},
       {"I will put the blue ball", "And after that give me the cylinder."},
       {"I will do that then.", "What will you do next?"},
       {"Then I will do something else, because you said", "Stop!"},
       {"I have stopped.", "Go on."}});
  EXPECT_THAT(said(), testing::Contains("The blue ball is behind the red cube now."));
  EXPECT_GT(place("the blue sphere").y, place("the red cube").y + 0.05);
  EXPECT_LT(std::hypot(place("the purple sphere").x - 0.15, place("the purple sphere").y - 0.06),
            0.04);
  EXPECT_EQ(heard().truth.collisions, 0) << heard().truth.collision;
}

TEST_F(PlayMateIsAsked, AboutThingsByTheirNamesAfterTheyWereMoved) {
  say("Put the round things next to each other.", "I hold the", {},
      {{"next to the purple ball now.", "Which of them is larger?"},
       {"It is the small blue ball.", "Take that one."}});
  EXPECT_THAT(said(), testing::Contains(testing::HasSubstr("I hold the blue ball now")));
}

TEST_F(PlayMateIsAsked, InWordsThatItUnderstandsInPart) {
  say("Would you be ever so sweet and pass me the green cube?", "Because", {},
      {{"Shall I give you the green cube?", "Better not."},
       {"What shall I do then?", "Put the red cube a bit to the right, and be graceful."},
       {"Shall I put the red cube a little to the right?", "Please do."},
       {"right now.", "Why did you move the cube?"}});
  EXPECT_THAT(said(), testing::Contains("I do not understand \"would you be ever so sweet and\"."));
  EXPECT_THAT(said(),
              testing::Contains("Because you said 'Put the red cube a bit to the right, and "
                                "be graceful'."));
  EXPECT_LT(std::hypot(place("the green cube").x - 0.20, place("the green cube").y + 0.06), 0.01);
  EXPECT_NEAR(place("the red cube").x, 0.06, 0.015);
}

TEST_F(PlayMateIsAsked, AndDoesNothingUnlessPeopleAgree) {
  say("Would you be ever so sweet and pass me the green cube?", "I have nothing to do", {},
      {{"Shall I give you the green cube?", "What colour is the cylinder?"},
       {"yellow.", "Yes."},
       {"Ok.", "Are you done?"}});
  EXPECT_LT(std::hypot(place("the green cube").x - 0.20, place("the green cube").y + 0.06), 0.01);
}

TEST_F(PlayMateIsAsked, ForWhatCannotBe) {
  say("What is in your hand?", "Because", {},
      {{"There is nothing.", "Put the red cube on the blue ball."},
       {"nothing stays on it", "Why can't you?"}});
  const std::string why =
    "blue ball is round: nothing stays on it. I can put the red cube next to it, or on the ";
  // Whichever flat thing is known first.
  for (const std::string begin : {"The ", "Because the "})
    EXPECT_THAT(said(), testing::Contains(testing::AnyOf(begin + why + "green cube.",
                                                         begin + why + "yellow cylinder.")));
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
