// From what is said to what is done, and to what the robot says about it.

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <vector>

namespace castor::planning::requests {

namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::HasSubstr;

/// The book is in the kitchen, as everybody says, and the robot in the hall.
class HallBody final : public ManagedComponent {
  void start() override {
    on_call<StateRequest>([this](const StateRequest&) {
      StateReply result{
        {{"robby", "robot"}, {"hall", "room"}, {"kitchen", "room"}, {"book", "thing"}},
        {"(= (is-in robby) " + place_ + ")", "(connected hall kitchen)",
         "(= (asserted-position book) kitchen)"}};
      if (is_seen_)
        result.facts.emplace_back("(= (perceived-position book) kitchen)");
      return result;
    });
    on_action<PlannedAction>([this](ActionInProgress& action, const PlannedAction& step) {
      if (!action.sleep_for(1h))
        return ActionResult::cancelled("the robot stands still");
      if (step.name == "move")
        place_ = step.arguments.at(1);
      else
        is_seen_ = true;
      return ActionResult::succeeded();
    });
  }

  std::string place_ = "hall";
  bool is_seen_ = false;
};

CASTOR_COMPONENT(HallBody, "moves to a kitchen, an hour for each step")

std::string dialogue(const std::string& text, const std::string& motives) {
  const std::string sa = "CPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n";
  const std::string words =
    " --lexicon \"english.ccg tabletop.words motives.words\" --base " CASTOR_LANGUAGE "\n";
  return "HOST localhost\nSUBARCHITECTURE communication\n" + sa +
         "CPP UM utterances UtteranceSource --turn 30s --text \"" + text + "\"\n" +
         "CPP UM parser UtteranceParser" + words + "CPP UM interpreter DialogueInterpreter" +
         words + "CPP UM monitor CommunicationBindingMonitor" + words +
         "CPP UM planner ContentPlanner --motivation motivation" + words +
         "CPP UM realiser SentenceRealiser" + words + "CPP UM speech SpeechOutput\n" +
         "SUBARCHITECTURE body\n" + sa + "CPP MG body HallBody\n" + "SUBARCHITECTURE planning\n" +
         sa + "CPP MG symbolic SymbolicPlanner --domain " CASTOR_DOMAINS "/explorer.pddl\n" +
         "CPP MG continual ContinualPlanner --agent robby --contributors body --executor body\n" +
         "SUBARCHITECTURE motivation\n" + sa + "CPP MG manager MotiveManager\n" +
         "CPP MG requests RequestMotives --motives " + motives + "\n";
}

class Requests : public testing::Test {
protected:
  std::string motives() {
    const auto file = folder_ / "robot.motives";
    std::ofstream{file} << "motive find\n"
                           "  on        Find\n"
                           "  goal      (K robby (perceived-position {patient}))\n"
                           "  words     find the {patient}\n"
                           "  because   {speaker} said '{text}'\n"
                           "  resources base\n"
                           "motive go\n"
                           "  on        Go\n"
                           "  goal      (= (is-in robby) {destination})\n"
                           "  words     go to the {destination}\n"
                           "  because   {speaker} said '{text}'\n"
                           "  resources base\n"
                           "motive answer\n"
                           "  on        question\n"
                           "  goal      (K robby (perceived-position {patient}))\n"
                           "  words     find out where the {patient} is\n"
                           "  because   {speaker} asked '{text}'\n"
                           "  resources base\n";
    return file.string();
  }

  static std::vector<std::string> said(TestSystem& system) {
    std::vector<std::string> result;
    for (const auto& entry : system.system().entries("communication"))
      if (auto x = entry->value.as<communication::SpokenOutputItem>())
        result.push_back(x->text);
    return result;
  }

  static void expect_said(TestSystem& system, const std::string& text) {
    try {
      system.wait_until(text, [&] {
        const auto all = said(system);
        return std::ranges::find(all, text) != all.end();
      });
    } catch (const ExpectationFailed&) {
      EXPECT_THAT(said(system), Contains(text));
    }
  }

private:
  castor::test::TemporaryFolder folder_;
};

TEST_F(Requests, AreAcceptedAndFulfilled) {
  TestSystem system{dialogue("Look for the book.", motives()),
                    {.patience = 4h, .simulated_time = true}};
  expect_said(system, "I will find the book.");
  expect_said(system, "It is done: find the book.");
}

TEST_F(Requests, AreExplained) {
  TestSystem system{
    dialogue(
      "Look for the book. What are you doing? Why are you doing that? What will you do next?",
      motives()),
    {.patience = 10s}};
  expect_said(system, "I will find the book.");
  expect_said(system, "I am about to find the book, because you said 'Look for the book'.");
  expect_said(system, "Because you said 'Look for the book'.");
  expect_said(system, "I have nothing else to do.");
}

TEST_F(Requests, AreUnderstoodHoweverTheyAreSaid) {
  for (const auto* text :
       {"Find the book.", "Find me the book.", "Search for the book.", "Please find the book."}) {
    TestSystem system{dialogue(text, motives()), {.patience = 10s}};
    expect_said(system, "I will find the book.");
  }
}

TEST_F(Requests, AreExplainedWhenTheyAreDone) {
  TestSystem system{
    dialogue("Go to the kitchen. What will you do next? Why did you do that?", motives()),
    {.patience = 4h, .simulated_time = true}};
  expect_said(system, "I will go to the kitchen.");
  expect_said(system, "I have nothing else to do.");
  expect_said(system, "It is done: go to the kitchen.");
  expect_said(system, "Because you said 'Go to the kitchen'.");
}

TEST_F(Requests, MayBeQuestionsThatTheRobotCannotAnswerYet) {
  TestSystem system{dialogue("Where is the book? What are you doing?", motives()),
                    {.patience = 4h, .simulated_time = true}};
  expect_said(system, "I will find out where the book is.");
  expect_said(system, "I am about to find out where the book is, because you asked 'Where is the "
                      "book'.");
  expect_said(system, "It is done: find out where the book is.");
}

TEST_F(Requests, AreRefusedIfNoMotiveIsForThem) {
  TestSystem system{dialogue("Push the book.", motives()), {.patience = 10s}};
  expect_said(system, "I do not know how to do that.");
}

} // namespace

} // namespace castor::planning::requests
