#include "castor/base/duration.hpp"
#include "castor/planning/symbolic/pddl_reader.hpp"
#include "castor/planning/symbolic/planner.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/duration_option.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/signals.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace castor::cli {

namespace {

struct PlanArguments {
  std::string domain;
  std::string problem;
  std::string time = "30s";
  std::size_t memory = 3000; // MiB
  bool anytime = false;
  bool json = false;
};

/// Sets a flag soon after the process is asked to end.
class CancelOnRequest {
public:
  CancelOnRequest() : thread_([this](const std::stop_token& stop) { watch(stop); }) {
    // nop
  }

  const std::atomic<bool>& flag() const { return is_cancelled_; }

private:
  void watch(const std::stop_token& stop) {
    constexpr std::chrono::milliseconds interval{20};
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any ended;
    while (!stop.stop_requested() && !is_cancelled_) {
      ended.wait_for(lock, stop, interval, [] { return false; });
      if (signals_.count() > 0)
        is_cancelled_ = true;
    }
  }

  Signals signals_;
  std::atomic<bool> is_cancelled_ = false;
  std::jthread thread_;
};

nlohmann::ordered_json json_of(const planning::PlanningResult& result) {
  using Outcome = planning::PlanningResult::Outcome;
  nlohmann::ordered_json x;
  x["outcome"] = result.outcome == Outcome::plan         ? "plan"
                 : result.outcome == Outcome::unsolvable ? "unsolvable"
                                                         : "unknown";
  x["explanation"] = explain(result);
  if (result.outcome == Outcome::plan) {
    x["cost"] = result.cost;
    x["optimal"] = result.is_optimal;
    x["steps"] = nlohmann::ordered_json::array();
    for (const auto& step : result.steps)
      x["steps"].push_back({{"action", step.action}, {"cost", step.cost}});
  }
  x["variables"] = result.variables;
  x["operators"] = result.operators;
  x["landmarks"] = result.landmarks;
  x["expanded"] = result.counts.expanded;
  x["evaluated"] = result.counts.evaluated;
  x["seconds"] = result.seconds;
  x["seconds_to_first_plan"] = result.first_plan_seconds;
  return x;
}

std::string text_of(const planning::PlanningResult& result) {
  std::string text;
  for (const auto& x : result.steps)
    text += fmt::format("({})  ; {}\n", x.action, x.cost);
  return text + fmt::format("; {}\n; {} variables, {} operators, {} expanded states, {:.2f} s\n",
                            explain(result), result.variables, result.operators,
                            result.counts.expanded, result.seconds);
}

int plan_task(const PlanArguments& arguments) {
  const auto read = planning::read_pddl(arguments.domain, arguments.problem);
  print(read.problems);
  if (has_errors(read.problems))
    return bad_input;
  const CancelOnRequest cancel;
  planning::PlanningOptions options;
  options.limits.time = duration(arguments.time);
  options.limits.memory_bytes = arguments.memory << 20;
  options.limits.is_cancelled = &cancel.flag();
  options.is_anytime = arguments.anytime;
  const auto result = planning::find_plan(read.task, options);
  if (arguments.json) {
    JsonOutput output;
    output.print(json_of(result));
  } else {
    print(text_of(result));
  }
  return result.outcome == planning::PlanningResult::Outcome::plan ? success : a_component_failed;
}

} // namespace

void add_plan(CLI::App& app, Action& chosen) {
  constexpr std::size_t most_memory = std::size_t{1} << 20; // MiB
  auto arguments = std::make_shared<PlanArguments>();
  auto* command = app.add_subcommand("plan", "find a plan for a task in PDDL");
  command->add_option("domain", arguments->domain, "the domain's file")
    ->type_name("FILE")
    ->required();
  command->add_option("problem", arguments->problem, "the problem's file")
    ->type_name("FILE")
    ->required();
  command->add_option("--time", arguments->time, "end after this time")
    ->type_name("TIME")
    ->check(check_duration)
    ->capture_default_str();
  command->add_option("--memory", arguments->memory, "use at most so many MiB")
    ->type_name("MIB")
    ->check(CLI::Range(std::size_t{1}, most_memory))
    ->capture_default_str();
  command->add_flag("--anytime", arguments->anytime,
                    "look for cheaper plans until the time is over, or none can be cheaper");
  add_json_flag(*command, arguments->json);
  command->footer(
    "Prints one action per line, and its cost after a semicolon. All problems of the files are "
    "printed\nwith their lines and what to do.\n"
    "Exit status: 0 plan, 1 there is none or none was found within the limits, 2 the files cannot "
    "be used.\n"
    "Examples: castor plan domain.pddl problem.pddl\n"
    "          castor plan domain.pddl problem.pddl --anytime --time 10s");
  on_call(*command, chosen, arguments, plan_task);
}

} // namespace castor::cli
