#include "castor/base/input_file.hpp"
#include "castor/base/log.hpp"
#include "castor/tools/chaos/plan_parser.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/seeds_option.hpp"
#include "castor/tools/cli/signals.hpp"
#include "castor/tools/cli/writable.hpp"
#include "castor/tools/simulation/campaign.hpp"
#include "castor/tools/simulation/system_faults.hpp"
#include "castor/tools/simulation/system_simulation.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <nlohmann/json.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace castor::cli {

namespace {

using simulation::CampaignReport;
using simulation::SystemSimulation;

/// Exit status of a simulation that was interrupted before its last seed.
constexpr int interrupted_early = 3;
/// A state file is written so often.
constexpr std::chrono::seconds state_interval{10};

struct SimulateArguments {
  std::string seeds = "1..10000";
  std::optional<std::uint64_t> seed;
  std::string faults;
  std::string state;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::size_t violations = 1;
  bool json = false;
};

/// The state that a file keeps, or one of nothing done if there is no such file. Throws
/// std::runtime_error if it cannot be continued with these seeds.
CampaignReport read_state(const std::string& file, const simulation::Seeds& seeds) {
  CampaignReport result;
  result.seeds = seeds;
  if (file.empty() || !std::filesystem::exists(file))
    return result;
  std::string text;
  try {
    text = read_input_file(file);
  } catch (const InputFileError& e) {
    throw std::runtime_error("cannot read " + file + ": " + e.what());
  }
  if (text.empty())
    return result;
  try {
    result = simulation::from_json(text);
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(file + ": " + e.what() +
                             ". Remove the file to begin anew, or name another one");
  }
  if (result.seeds.from != seeds.from)
    throw std::runtime_error(fmt::format(
      "{}: it is the state of a simulation from seed {}, not from {}. Begin with that seed, or "
      "name another file",
      file, result.seeds.from, seeds.from));
  if (result.done > seeds.size())
    throw std::runtime_error(
      fmt::format("{}: the seeds up to {} are done already, which is beyond {}", file,
                  result.seeds.from + result.done - 1, seeds.to));
  result.seeds = seeds;
  return result;
}

/// A reader, or a power cut, meets the former state or this one, never a part of it.
void write_state(const std::string& file, const CampaignReport& report) {
  auto unfinished = file + ".new";
  {
    auto out = create(unfinished);
    out << simulation::to_json(report) << '\n';
    out.close();
    if (!out)
      throw std::runtime_error("cannot write " + unfinished);
  }
  std::filesystem::rename(unfinished, file);
}

class SimulateCommand {
public:
  explicit SimulateCommand(const SimulateArguments& arguments) : arguments_(arguments) {}

  int run() {
    if (arguments_.seed)
      return show_one(*arguments_.seed);
    if (!arguments_.faults.empty())
      throw std::runtime_error("--faults stands for the faults of one seed: give --seed, too");
    auto seeds = simulation::parse_seeds(arguments_.seeds);
    auto before = read_state(arguments_.state, seeds);
    const auto first_done = before.done;
    keep(before);
    simulation::CampaignOptions options;
    options.seeds = seeds;
    options.threads = arguments_.threads;
    options.most_violations = arguments_.violations;
    options.interrupted = [this] { return signals_.count() > 0; };
    std::optional<Progress> progress{"simulate"};
    auto saved = Clock::now();
    options.progress = [&](const CampaignReport& x) {
      if (progress->due())
        progress->update(double(x.done), double(seeds.size()), text_of_progress(x));
      if (Clock::now() - saved < state_interval)
        return;
      saved = Clock::now();
      keep(x);
    };
    auto report = simulation::run_campaign(std::move(before), options);
    progress.reset();
    keep(report);
    print(arguments_.json ? simulation::to_json(report) + '\n' : simulation::to_text(report));
    if (!report.held())
      return a_component_failed;
    if (report.is_complete())
      return success;
    std::fprintf(stderr, "interrupted after %llu systems%s\n",
                 static_cast<unsigned long long>(report.done - first_done),
                 arguments_.state.empty()
                   ? "; with --state FILE it could be continued"
                   : ("; the same command goes on, from " + arguments_.state).c_str());
    return interrupted_early;
  }

private:
  using Clock = std::chrono::steady_clock;

  static std::string text_of_progress(const CampaignReport& x) {
    return fmt::format("{:.0f} systems a second, faults: {}, outages: {}, violations: {}",
                       x.systems_per_second(), x.happened.sum("faults"),
                       x.happened.count("outages", "component down"), x.violations.size());
  }

  void keep(const CampaignReport& x) const {
    if (!arguments_.state.empty())
      write_state(arguments_.state, x);
  }

  /// One system, with all that its clients did, and with the faults of its seed or those of a file.
  int show_one(std::uint64_t seed) const {
    std::optional<faults::FaultPlan> plan;
    if (!arguments_.faults.empty()) {
      auto read = faults::parse_plan_file(arguments_.faults);
      if (!read.ok()) {
        cli::print(read.diagnostics);
        return bad_input;
      }
      if (auto problems = simulation::check_simulated(*read.plan, seed); !problems.empty()) {
        cli::print(problems);
        return bad_input;
      }
      plan = *std::move(read.plan);
    }
    SystemSimulation simulation;
    if (!arguments_.json)
      set_log_level(LogLevel::debug);
    auto result = simulation.run(seed, plan);
    set_log_level(LogLevel::off);
    CampaignReport report;
    report.seeds = {seed, seed};
    report.add(result);
    if (result.is_wrong())
      report.violations.push_back(simulation::violation_of(simulation, result));
    if (arguments_.json) {
      print(simulation::to_json(report) + '\n');
    } else {
      for (auto& x : result.history)
        fmt::print("entry {}: {}\n", x.entry, to_string(x));
      fmt::print("faults:\n{}",
                 result.faults.statements.empty() ? "none\n" : to_string(result.faults));
      print(simulation::to_text(report));
    }
    return report.held() ? success : a_component_failed;
  }

  Signals signals_;
  const SimulateArguments& arguments_;
};

} // namespace

void add_simulate(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
    "simulate", "simulate whole systems with random faults, and check Castor's guarantees");
  auto arguments = std::make_shared<SimulateArguments>();
  auto* seeds = command
                  ->add_option("--seeds", arguments->seeds,
                               "simulate one system for each of these seeds; by default 1..10000")
                  ->type_name("FROM..TO")
                  ->check(check_seeds);
  auto* seed =
    command->add_option("--seed", arguments->seed, "simulate this seed only, and print every event")
      ->type_name("N");
  command
    ->add_option("--faults", arguments->faults,
                 "with --seed: the faults of this plan instead of the seed's own")
    ->type_name("FILE")
    ->check(CLI::ExistingFile);
  auto* state =
    command
      ->add_option("--state", arguments->state,
                   "file that keeps the progress: the same command continues from there")
      ->type_name("FILE")
      ->check(check_output_file);
  command
    ->add_option("--threads", arguments->threads,
                 "how many systems are simulated at a time; by default one for each processor")
    ->type_name("N")
    ->check(CLI::Range(1, 1024));
  command->add_option("--violations", arguments->violations, "end after so many; by default 1")
    ->type_name("N")
    ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}));
  seed->excludes(seeds);
  seed->excludes(state);
  add_json_flag(*command, arguments->json);
  command->footer(
    "The systems are Castor's own: their architecture, components and faults follow from the "
    "seed.\n"
    "Exit status: 0 if everything held, 1 if something did not, 2 if the simulation could not be "
    "made, 3 if it was interrupted.\n"
    "Example: castor simulate --seeds 1..1000000 --state simulation.json");
  command->callback(
    [&chosen, arguments] { chosen = [arguments] { return SimulateCommand{*arguments}.run(); }; });
}

} // namespace castor::cli
