// Two people with conflicting wishes, and a battery that becomes low while one of them is
// fulfilled; what the robot says about it.

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/tests/planning/motivation/desk.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

namespace castor::planning::test {

struct Said {
  std::string question;
  std::string answer;
};
CASTOR_REFLECT(Said, question, answer)

struct PeopleDone {
  bool all = true;
};
CASTOR_REFLECT(PeopleDone, all)

namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Ann and Bob, who want the ball elsewhere, and are curious.
class People final : public UnmanagedComponent {
  void run() override {
    wish("ann", "left");
    sleep_for(pause_.get());
    wish("bob", "right");
    sleep_for(pause_.get());
    if (!curious_) {
      await_end();
    } else {
      ask("doing", {MotiveQuestionKind::doing, ""});
      ask("why not right", {MotiveQuestionKind::why_not, "right"});
      while (open([](const Motive& x) { return x.kind == "charge"; }) == 0)
        sleep_for(10ms);
      while (open([](const Motive& x) {
               return x.kind == "charge" && x.status == MotiveStatus::active;
             }) == 0)
        sleep_for(10ms);
      ask("doing then", {MotiveQuestionKind::doing, ""});
      ask("next then", {MotiveQuestionKind::next, ""});
      ask("why not left then", {MotiveQuestionKind::why_not, "left"});
      await_end();
      ask("why left", {MotiveQuestionKind::why, "left"});
      ask("why charge", {MotiveQuestionKind::why, "charge"});
      wish("ann", "left");
      await_end();
    }
    add(here("done"), PeopleDone{});
  }

  void wish(const std::string& who, const std::string& side) {
    Motive x;
    x.kind = "put";
    x.goal.goal = "(" + side + " ball)";
    x.words = "put the ball " + side;
    x.because = who + " said 'put the ball " + side + "'";
    x.asker = who;
    x.about = "ball";
    x.priority = 3;
    x.resources = {"arm", "base"};
    add(std::move(x));
  }

  void ask(const std::string& question, const MotiveQuestion& x) {
    add(here(question), Said{question, call<MotiveQuestion, MotiveAnswer>("motivation", x).words});
  }

  template <class F>
  std::size_t open(F&& is_meant) {
    const auto all = read_all<Motive>();
    return static_cast<std::size_t>(std::ranges::count_if(all, [&](const EntryOf<Motive>& x) {
      return x->status != MotiveStatus::completed && x->status != MotiveStatus::rejected &&
             x->status != MotiveStatus::dropped && is_meant(*x);
    }));
  }

  void await_end() {
    while (open([](const Motive&) { return true; }) > 0)
      sleep_for(10ms);
  }

  Option<std::chrono::milliseconds> pause_{this, "pause", 500ms, "between what they do"};
  Option<bool> curious_{this, "curious", true, "whether they ask"};
};

CASTOR_COMPONENT(People, "want things of the robot, and ask why")

class DeskSystem {
public:
  explicit DeskSystem(bool is_simulated, const std::string& body = "",
                      const std::string& people = "")
    : system_(text(body, people), {.patience = 1min, .simulated_time = is_simulated}) {
    // nop
  }

  TestSystem& system() { return system_; }

  std::string answer(const std::string& question) {
    return system_.expect_entry("Said in motivation where question == \"" + question + "\"")
      ->value.as<Said>()
      ->answer;
  }

  /// The motive whose words have this in them, the one written last.
  Motive motive(const std::string& words) {
    Motive result;
    for (const auto& entry : system_.system().entries("motivation"))
      if (auto x = entry->value.as<Motive>();
          x && x->words.find(words) != std::string::npos &&
          (result.history.empty() || x->history.front().time < result.history.front().time))
        result = *x;
    return result;
  }

  std::vector<std::string> replies_to(const std::string& who) {
    std::vector<std::string> result;
    for (const auto& entry : system_.system().entries("motivation"))
      if (auto x = entry->value.as<MotiveAcknowledgement>(); x && x->asker == who)
        result.push_back(x->words);
    return result;
  }

  Desk desk() { return *system_.expect_entry("Desk in body")->value.as<Desk>(); }

private:
  static std::string text(const std::string& body, const std::string& people) {
    const std::string sa =
      "CPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n";
    return "HOST localhost\nSUBARCHITECTURE body\n" + sa + "CPP MG body DeskBody " + body +
           "\nSUBARCHITECTURE planning\n" + sa +
           "CPP MG planner SymbolicPlanner --domain " CASTOR_DESK "/desk.pddl\n"
           "CPP MG continual ContinualPlanner --agent robby --contributors body --executor body\n"
           "SUBARCHITECTURE motivation\n" +
           sa +
           "CPP MG manager MotiveManager\nCPP MG facts FactMotives --contributors body --period "
           "100ms --motives " CASTOR_DESK "/desk.motives\nCPP UM people People " +
           people + "\nSUPERVISE * RESTARTS 1000 IN 10s\n";
  }

  TestSystem system_;
};

std::vector<MotiveStatus> statuses_of(const Motive& x) {
  std::vector<MotiveStatus> result;
  for (const auto& event : x.history)
    result.push_back(event.status);
  return result;
}

TEST(MotivationSystem, FulfilsOneWishAfterAnUrgentOneAndSaysWhy) {
  DeskSystem desk(true);
  desk.system().expect_entry("PeopleDone in motivation");
  EXPECT_THAT(desk.desk().log, ElementsAre("charge", "put-left"));
  using enum MotiveStatus;
  EXPECT_THAT(statuses_of(desk.motive("left")),
              ElementsAre(proposed, queued, active, preempted, queued, active, completed));
  EXPECT_THAT(statuses_of(desk.motive("right")), ElementsAre(proposed, rejected));
  EXPECT_THAT(statuses_of(desk.motive("charge")), ElementsAre(proposed, queued, active, completed));
  EXPECT_EQ(desk.answer("doing"),
            "I am about to put the ball left, because ann said 'put the ball left'.");
  EXPECT_EQ(
    desk.answer("why not right"),
    "Because I am about to put the ball left, because ann said 'put the ball left' before.");
  EXPECT_EQ(desk.answer("doing then"), "I am about to charge, because my battery is low.");
  EXPECT_EQ(desk.answer("next then"),
            "Then I will put the ball left, because ann said 'put the ball left'.");
  EXPECT_EQ(desk.answer("why not left then"),
            "I will put the ball left later: it is more urgent to "
            "charge, because my battery is low.");
  EXPECT_EQ(desk.answer("why left"), "Because ann said 'put the ball left'.");
  EXPECT_EQ(desk.answer("why charge"), "Because my battery is low.");
  EXPECT_THAT(desk.replies_to("bob"),
              ElementsAre("I cannot put the ball right, because I am about to put the ball left, "
                          "because ann said 'put the ball left' before."));
  EXPECT_THAT(desk.replies_to("ann"),
              testing::IsSupersetOf({"I will put the ball left.", "It is done: put the ball left.",
                                     "It is so already."}));
  desk.system().expect_nobody_else_down();
}

TEST(MotivationSystem, LosesNoMotiveThoughTheManagerOrThePlannerEnds) {
  const auto* text = std::getenv("CASTOR_STORY_RUNS");
  const int runs = text ? std::atoi(text) : 2;
  for (int i = 0; i < runs; ++i)
    for (const auto* name : {"manager", "planner"}) {
      DeskSystem desk(false, "--step 50ms --low-after 30ms", "--pause 1ms --curious false");
      desk.system().expect_entry("Motive in motivation where status == \"active\"");
      desk.system().inject(std::string("crash ") + name);
      desk.system().expect_entry("PeopleDone in motivation");
      desk.system().wait_until("the ball is left, and the battery charged", [&] {
        return desk.desk().ball == "left" && desk.desk().is_charged;
      });
      desk.system().expect_nobody_else_down({name});
      EXPECT_EQ(desk.motive("left").status, MotiveStatus::completed) << name;
    }
}

} // namespace

} // namespace castor::planning::test
