// Something fails in the midst of what the PlayMate's arm was asked to do. CASTOR_ARM_KILLS makes
// that many runs of each kind in place of one; CASTOR_ARM_KILLS_FILE keeps their results, and those
// that are in it are not made again.

#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/body/arm_evaluation.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/tabletop/types.hpp"
#include "castor/tests/playmate/playmate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using namespace manipulation;

/// What the witness of a run waits for, and has seen.
struct Witnessed {
  std::atomic<bool> is_accepted = false;
  /// The test has injected the failure.
  std::atomic<bool> has_failed = false;
  std::atomic<bool> is_over = false;
  /// From the failure until the arm rested, and until the end was said, ms.
  std::atomic<std::int64_t> rested_after{-1};
  std::int64_t over_after = -1;
  /// The last words about the task.
  std::string words;
  ArmStatus truth;
  ArmEvaluation evaluation;
  std::string holds;
  std::vector<vision::SceneObject> seen;
  planning::RememberedTable remembered;
};

Witnessed& witnessed() {
  static Witnessed instance;
  return instance;
}

/// Follows the arm, hears what the robot says, and compares in the end.
class ArmWitness final : public UnmanagedComponent {
  void start() override {
    on_push<ArmState>("arm", [this](auto& x) { follow(*x); });
  }

  void follow(const ArmState& x) {
    auto& told = witnessed();
    if (!told.has_failed)
      return;
    if (!failed_)
      failed_ = now();
    if (x.rests && told.rested_after < 0)
      told.rested_after = (now() - *failed_) / 1ms;
  }

  void run() override {
    const auto given_up = now() + 300s;
    while (is_running() && now() < given_up && !is_task_over())
      sleep_for(500ms);
    if (failed_)
      witnessed().over_after = (now() - *failed_) / 1ms;
    // Its arm may still have to go home, and vision to look.
    sleep_for(40s);
    look();
    witnessed().is_over = true;
  }

  bool is_task_over() {
    for (const auto& x : read_all_in<communication::SpokenOutputItem>("communication")) {
      const auto& text = x->text;
      if (text.starts_with("I will"))
        witnessed().is_accepted = true;
      if (text.ends_with("now.") || text.starts_with("I cannot") || text.starts_with("It is so")) {
        witnessed().words = text;
        return true;
      }
    }
    return false;
  }

  void look() {
    auto& told = witnessed();
    told.truth = *pull<ArmStatus>("arm");
    for (const auto& x : read_all_in<ArmEvaluation>("table"))
      told.evaluation = *x;
    for (const auto& x : read_all_in<Manipulation>("manipulation"))
      told.holds = x->holds;
    for (const auto& x : read_all_in<vision::SceneObject>("vision"))
      told.seen.push_back(*x);
    for (const auto& x : read_all_in<planning::RememberedTable>("table"))
      told.remembered = *x;
  }

  std::optional<Timestamp> failed_;
};
CASTOR_COMPONENT(ArmWitness, "judges how a task ends in which something has failed")

/// What fails at once, in turn for one run after the other.
struct Failure {
  std::string name;
  std::vector<std::vector<std::string>> components;
};

const std::vector<Failure>& failures() {
  static const std::vector<Failure> result{
    {"arm's controller", {{"arm"}, {"arm", "executor"}}},
    {"planner", {{"continual"}, {"planner"}, {"requests"}, {"motives"}}},
    {"executor", {{"executor"}, {"table-executor"}, {"executor"}, {"manipulation_wm"}}},
    {"vision", {{"vision_wm"}, {"segmentor", "change-detector", "feature-extractor"}, {"camera"}}},
  };
  return result;
}

const char* setting(const char* name) {
  const char* result = std::getenv(name);
  return result == nullptr ? "" : result;
}

std::size_t runs_of_each() {
  return static_cast<std::size_t>(std::max(1, std::atoi(setting("CASTOR_ARM_KILLS"))));
}

/// A line of the file of results begins so.
bool is_done(const std::string& head) {
  std::ifstream file{setting("CASTOR_ARM_KILLS_FILE")};
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(head))
      return true;
  return false;
}

double off(const TrueThing& thing, double x, double y) {
  return std::hypot(thing.pose.position.x - x, thing.pose.position.y - y);
}

/// What is not as it ought to be; by the truth.
std::vector<std::string> problems(bool is_commander) {
  constexpr double near = 0.03;
  // 300 ms that a command holds, 800 ms to stop, 200 ms that it lags behind, and between states.
  constexpr std::int64_t rest_bound = 1340;
  const auto& told = witnessed();
  std::vector<std::string> result;
  if (told.words.empty())
    result.push_back("no word about the end");
  if (is_commander && (told.rested_after < 0 || told.rested_after > rest_bound))
    result.push_back(fmt::format("at rest after {} ms", told.rested_after.load()));
  if (told.evaluation.uncommanded > 1.0)
    result.push_back(fmt::format("{} s without commands", told.evaluation.uncommanded));
  if (told.truth.collisions > 0)
    result.push_back(told.truth.collision);
  if (told.evaluation.dropped > 0)
    result.push_back(told.evaluation.drop);
  if (told.evaluation.taken == 0 && told.words.ends_with("now."))
    result.push_back("nothing was taken");
  for (const auto& thing : told.truth.things) {
    // "the blue sphere"
    const auto colour = thing.name.substr(4, thing.name.find(' ', 4) - 4);
    if (thing.support == "the gripper") {
      if (told.holds.empty())
        result.push_back(thing.name + " is held, and the executor does not know");
      continue;
    }
    if (std::ranges::none_of(told.seen, [&](const auto& x) {
          return x.colour.value == colour && off(thing, x.box.centroid.x, x.box.centroid.y) < near;
        }))
      result.push_back("vision has lost " + thing.name + " on " + thing.support);
    if (std::ranges::none_of(told.remembered.things, [&](const auto& x) {
          return off(thing, x.place.x, x.place.y) < near && !x.is_held;
        }))
      result.push_back("the executor has forgotten " + thing.name + " on " + thing.support);
  }
  const auto thing = [&](const char* name) {
    return *std::ranges::find(told.truth.things, name, &TrueThing::name);
  };
  const auto ball = thing("the blue sphere").pose.position;
  const auto cube = thing("the red cube").pose.position;
  if (told.words.ends_with("now.") && !(ball.x - cube.x > std::abs(ball.y - cube.y)))
    result.push_back("it is not so");
  return result;
}

class ArmKills : public testing::TestWithParam<std::size_t> {
protected:
  static void run(const Failure& failure, std::size_t number, const std::string& head) {
    std::seed_seq seed{GetParam(), number};
    std::mt19937_64 random(seed);
    // The task takes 20 s from when it is accepted.
    const std::chrono::milliseconds after{std::uniform_int_distribution(0, 20'000)(random)};
    auto& told = witnessed();
    told.is_accepted = told.has_failed = told.is_over = false;
    told.rested_after = told.over_after = -1;
    told.words = told.holds = {};
    told.truth = {};
    told.evaluation = {};
    told.seen.clear();
    told.remembered = {};
    auto options = playmate_options({{"arm", "true"},
                                     {"restarts", "20"},
                                     {"say", "Put the blue ball to the right of the red cube."}});
    options.patience = 900s;
    options.seed = number + 1;
    TestSystem system(playmate_cast() + "SUBARCHITECTURE watching\n"
                                        "CPP WM SubarchitectureWorkingMemory\n"
                                        "CPP TM AlwaysPositiveTaskManager\n"
                                        "CPP UM witness ArmWitness\n",
                      options);
    system.wait_until("the task is accepted", [] { return witnessed().is_accepted.load(); });
    system.advance(after);
    const auto& components = failure.components[number % failure.components.size()];
    std::string names;
    for (const auto& x : components) {
      system.inject("crash " + x);
      names += (names.empty() ? "" : "+") + x;
    }
    told.has_failed = true;
    system.wait_until("the task is over", [] { return witnessed().is_over.load(); });
    const bool is_commander =
      components.back() == "executor" || components.back() == "manipulation_wm";
    const auto found = problems(is_commander);
    auto line = fmt::format("{}\t{}\t{}\t{}\t{}\t{:.2f}\t{}\t{}", head, names, after.count(),
                            is_commander ? told.rested_after.load() : -1, told.over_after,
                            told.evaluation.uncommanded, told.words, told.holds);
    for (const auto& x : found) {
      ADD_FAILURE() << head << ", " << names << " after " << after.count() << " ms: " << x;
      line += "\t! " + x;
    }
    if (std::ofstream file{setting("CASTOR_ARM_KILLS_FILE"), std::ios::app})
      file << line << std::endl;
    fmt::print("{}\n", line);
  }
};

TEST_P(ArmKills, EndInRestAndInWordsAndNothingIsLost) {
  const auto& failure = failures()[GetParam()];
  for (std::size_t i = 0; i < runs_of_each(); ++i)
    if (const auto head = fmt::format("{}\t{}", failure.name, i + 1); !is_done(head + '\t'))
      run(failure, i, head);
}

INSTANTIATE_TEST_SUITE_P(Each, ArmKills, testing::Range<std::size_t>(0, failures().size()));

} // namespace

} // namespace castor::test
