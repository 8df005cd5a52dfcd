// What people ask to do with the things of random tables, as typed sentences, through the whole
// PlayMate with its arm, in simulated time: put, take, sort, clear, swap; in two of five tables
// with an injected fault.
//
//   table_tasks_benchmark [FROM] [COUNT] [FOLDER]
//
// Tables FROM, FROM + 1, ...; a line for each, so that a long run can be made in parts. Judged by
// the true places of things, not by what the robot says. FOLDER is for film strips,
// TABLE/action-1.png.

#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/benchmarks/manipulation/random_table.hpp"
#include "castor/benchmarks/manipulation/table_tasks.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace castor::manipulation {

namespace {

using namespace std::chrono_literals;
using communication::SpokenOutputItem;
using planning::ContinualPlanning;
using planning::MotiveAcknowledgement;
using planning::MotiveReply;

constexpr const char* arm_file = CASTOR_CONFIGS "/arms/katana.arm";

struct Result {
  bool is_accepted = false;
  /// What the robot said last.
  std::string said;
  bool says_done = false;
  double seconds = 0;
  /// Plans of the arm, and those of the planner after the first.
  int tries = 0;
  std::size_t replans = 0;
  /// Steps that succeeded, and those of the last plan.
  std::string steps;
  ArmStatus truth;
  /// At the end, and when that was since the system began.
  std::vector<double> joints;
  Timestamp end{0};
};

struct Asked {
  Result result;
  std::atomic<bool> is_over = false;
};

Asked& asked() {
  static Asked instance;
  return instance;
}

/// Waits until the robot has said how it ended.
class TaskListener final : public UnmanagedComponent {
  void start() override {
    on_change(overwritten<Manipulation>().anywhere(), [this](const ChangeEvent& event) {
      const auto told = read<Manipulation>(event.address);
      asked().result.tries += told->status == ManipulationStatus::planning;
    });
  }

  void run() override {
    auto& result = asked().result;
    const auto given_up = now() + 1500s;
    auto begun = now();
    bool is_over = false;
    while (is_running() && !is_over && now() < given_up) {
      sleep_for(500ms);
      for (const auto& x : read_all_in<MotiveAcknowledgement>("motivation")) {
        if (x->reply != MotiveReply::accepted)
          is_over = true;
        else if (!std::exchange(result.is_accepted, true))
          begun = now();
        if (x->reply == MotiveReply::done || x->reply == MotiveReply::already_so)
          result.says_done = true;
        if (x->reply != MotiveReply::accepted)
          result.said = x->words;
      }
      // It asks back, or does not understand.
      if (!result.is_accepted && !is_over)
        for (const auto& x : read_all_in<SpokenOutputItem>("communication")) {
          if (result.said.empty())
            begun = now();
          result.said = x->text;
          is_over = now() - begun > 10s;
        }
    }
    if (!is_over)
      result.said = "(nothing in the end)";
    result.seconds = std::chrono::duration<double>(now() - begun).count();
    for (const auto& x : read_all_in<ContinualPlanning>("planning")) {
      for (const auto& step : x->done)
        result.steps += step + ", ";
      if (x->plans.empty())
        continue;
      result.replans += x->plans.size() - 1;
      result.steps += "then to";
      for (const auto& step : x->plans.back().steps)
        result.steps += ' ' + step.action + ',';
    }
    result.truth = *pull<ArmStatus>("arm");
    result.joints = pull<ArmState>("arm")->positions;
    result.end = now();
    asked().is_over = true;
  }
};
CASTOR_COMPONENT(TaskListener, "waits until the robot has said how a task ended")

/// Of each kind of task, four in ten tables have one: each of these once.
std::map<std::string, std::string> fault_of(std::uint64_t seed) {
  const auto row = (seed + 4) / 5;
  const auto which = (row + (seed + 4) % 5) % 5;
  if (which > 1)
    return {};
  std::mt19937_64 random(seed);
  switch (which + 2 * (row / 5 % 2)) {
    case 0:
      return {{"missed_grasp", "0.3"}};
    case 1:
      return {{"dropped", "0.3"}};
    case 2: {
      constexpr const char* joints[] = {"turret", "lift", "elbow", "wrist", "roll"};
      return {{"sticking_joint", joints[random() % 5]},
              {"sticks_after", std::to_string(10'000 + random() % 20'000) + "ms"}};
    }
    default:
      return {{"arm_delay", std::to_string(100 + random() % 150) + "ms"}};
  }
}

/// The joint that has stuck meanwhile.
std::optional<StillJoint> still_joint(std::uint64_t seed, const Result& result) {
  const auto fault = fault_of(seed);
  const auto sticks = fault.find("sticking_joint");
  if (sticks == fault.end() ||
      result.end < std::chrono::milliseconds{std::atoi(fault.at("sticks_after").c_str())})
    return {};
  const auto arm = load_arm(arm_file).arm;
  const auto moving = moving_joints(arm);
  const auto found =
    std::ranges::find(moving, sticks->second, [&](std::size_t i) { return arm.joints[i].name; });
  const auto index = static_cast<std::size_t>(found - moving.begin());
  return StillJoint{index, result.joints.at(index)};
}

std::string words_of(const std::map<std::string, std::string>& fault) {
  std::string result;
  for (const auto& [name, value] : fault)
    result += (result.empty() ? "" : " ") + name + ' ' + value;
  return result.empty() ? "no fault" : result;
}

Result run(const TableTask& task, const std::string& scene_file, const std::string& output,
           std::uint64_t seed) {
  asked().result = {};
  asked().is_over = false;
  TestSystemOptions options;
  options.file = CASTOR_CONFIGS "/playmate.cast";
  options.simulated_time = true;
  options.patience = 3000s;
  options.variables = fault_of(seed);
  options.variables.merge(std::map<std::string, std::string>{
    {"arm", "true"},
    {"table", scene_file},
    {"arm_at", benchmark_arm_at},
    {"arm_rest", benchmark_arm_rest},
    {"arm_seed", std::to_string(seed)},
    {"say", task.sentence},
    {"output", output.empty() ? output : output + '/' + std::to_string(seed)}});
  TestSystem system(text_of_file(CASTOR_CONFIGS "/playmate.cast") +
                      "SUBARCHITECTURE listening\nCPP WM SubarchitectureWorkingMemory\n"
                      "CPP TM AlwaysPositiveTaskManager\nCPP UM listener TaskListener\n",
                    options);
  system.wait_until("the task is over", [] { return asked().is_over.load(); });
  return asked().result;
}

struct Figures {
  /// Whatever the fault.
  int solvable = 0;
  /// Of these, those that are not any more with the joint that has stuck.
  int prevented = 0;
  int done = 0;
  int unsolvable = 0;
  int said_wrongly = 0;
  std::int64_t collisions = 0;
  int tries = 0;
  std::size_t replans = 0;
  std::vector<double> seconds;
};

int measure(std::uint64_t from, int count, const std::string& output) {
  const auto scene_file =
    std::filesystem::temp_directory_path() / fmt::format("tasks-{}.scene", getpid());
  std::array<Figures, std::size(task_kinds)> figures;
  for (int i = 0; i < count; ++i) {
    const auto seed = from + static_cast<std::uint64_t>(i);
    const auto task = random_table_task(seed);
    std::ofstream(scene_file) << scene_text(task.things);
    const auto result = run(task, scene_file.string(), output, seed);
    const auto wrong = what_is_wrong(task, result.truth.things);
    // What was done has a plan.
    const auto why_not = wrong.empty() ? wrong : why_unsolvable(task, arm_file);
    const auto still = still_joint(seed, result);
    const auto prevented = wrong.empty() || !why_not.empty() || !still
                             ? std::string{}
                             : why_unsolvable(task, arm_file, still, result.truth.things);
    auto& x = figures[static_cast<std::size_t>(task.kind)];
    (why_not.empty() ? x.solvable : x.unsolvable) += 1;
    x.prevented += !prevented.empty();
    x.done += wrong.empty();
    x.said_wrongly += result.says_done != wrong.empty();
    x.collisions += result.truth.collisions;
    x.tries += result.tries;
    x.replans += result.replans;
    if (wrong.empty())
      x.seconds.push_back(result.seconds);
    fmt::print(
      "{}: {} [{}] {}{}: \"{}\"; {:.0f} s, {} tries, {} replans, {} missed, {} dropped, {} "
      "collisions{}{}{}\n",
      seed, task.sentence, words_of(fault_of(seed)), wrong.empty() ? "done" : "NOT done: ", wrong,
      result.said, result.seconds, result.tries, result.replans, result.truth.missed,
      result.truth.dropped, result.truth.collisions,
      result.truth.collisions > 0 ? " (" + result.truth.collision + ")" : "",
      why_not.empty() ? "" : "; not solvable: " + why_not,
      prevented.empty() ? "" : "; not solvable with the joint stuck: " + prevented);
    if (!wrong.empty())
      fmt::print("  {}\n", result.steps);
    std::fflush(stdout);
  }
  std::filesystem::remove(scene_file);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const auto& x = figures[i];
    fmt::print(
      "{}: {} of {} solvable done ({} prevented by a joint), {} not solvable, {} said wrongly, "
      "median {:.0f} s, {} tries, {} replans, {} collisions\n",
      task_kinds[i], x.done, x.solvable, x.prevented, x.unsolvable, x.said_wrongly,
      median(x.seconds), x.tries, x.replans, x.collisions);
  }
  return 0;
}

} // namespace

} // namespace castor::manipulation

int main(int argc, char** argv) {
  const castor::manipulation::Arguments argument{argc, argv};
  return castor::manipulation::measure(std::strtoull(argument(1, "1").c_str(), nullptr, 10),
                                       std::atoi(argument(2, "50").c_str()), argument(3, ""));
}
