#include "castor/actors/cli/progress.hpp"
#include "castor/actors/component/log.hpp"
#include "castor/tests/simulation/system_simulation.hpp"
#include "castor/tests/support/seeds.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

#include <unistd.h>

namespace castor::simulation {

namespace {

using test::parse_seeds;
using test::Seeds;

/// The faults as a plan, each on a line.
std::string lines(const faults::FaultPlan& x) {
  return x.statements.empty() ? "no fault at all\n" : to_string(x);
}

/// What was done before, as a number in a file: all up to that.
std::uint64_t done_before(const std::string& file) {
  std::uint64_t result = 0;
  std::ifstream{file} >> result;
  return result;
}

void report(SystemSimulation& simulation, std::uint64_t seed, const SystemResult& result) {
  fmt::print("seed {}:\n{}\n", seed, to_string(result));
  auto few = minimised(simulation, seed, result.faults);
  fmt::print("Of its {} faults, these are enough:\n{}", result.faults.statements.size(),
             lines(few));
  fmt::print(
    "Once more: castor_system_simulation --seed {0}, with fewer faults: --seed {0} --faults "
    "FILE-WITH-THESE\n",
    seed);
}

/// The number of the seed that something is wrong with, if there is one.
std::optional<std::uint64_t> run(SystemSimulation& simulation, Seeds seeds,
                                 const std::string& state) {
  auto begin = std::chrono::steady_clock::now();
  auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  if (!state.empty())
    seeds.from = std::max(seeds.from, done_before(state) + 1);
  std::uint64_t undecided = 0;
  std::uint64_t faults = 0;
  std::uint64_t failures = 0;
  std::uint64_t losses = 0;
  std::uint64_t operations = 0;
  std::uint64_t steps = 0;
  auto reported = seconds();
  const bool is_watched = cli::Progress::is_shown_on(STDERR_FILENO);
  std::optional<cli::Progress> progress{"system simulation"};
  for (auto seed = seeds.from; seed <= seeds.to; ++seed) {
    if (progress->due())
      progress->update(double(seed - seeds.from), double(seeds.to - seeds.from + 1),
                       fmt::format("seed {}, {} faults, {} undecided", seed, faults, undecided));
    auto result = simulation.run(seed);
    faults += result.faults.statements.size();
    failures += result.failures;
    losses += result.losses;
    operations += result.history.size();
    steps += result.steps;
    if (result.is_wrong()) {
      progress.reset();
      report(simulation, seed, result);
      return seed;
    }
    undecided += !result.ok();
    if (seed % 1000 == 0 && !state.empty())
      std::ofstream{state} << seed << '\n';
    if (!is_watched && seconds() - reported > 30) {
      reported = seconds();
      fmt::print("{} of {}, {:.0f}/s\n", seed, seeds.to, double(seed - seeds.from + 1) / reported);
      std::fflush(stdout);
    }
  }
  progress.reset();
  if (!state.empty() && seeds.to >= seeds.from)
    std::ofstream{state} << seeds.to << '\n';
  auto runs = seeds.to < seeds.from ? 0 : seeds.to - seeds.from + 1;
  auto each = [&](std::uint64_t x) { return runs == 0 ? 0.0 : double(x) / double(runs); };
  fmt::print(
    "{} systems without a violation, {} undecided, {:.0f}/s; each with {:.1f} faults, {:.1f} "
    "failures, {:.2f} losses of a working memory, {:.0f} operations, {:.0f} messages\n",
    runs, undecided, double(runs) / seconds(), each(faults), each(failures), each(losses),
    each(operations), each(steps));
  return std::nullopt;
}

/// With the faults of the seed, or with those of a file.
void show(SystemSimulation& simulation, std::uint64_t seed, const std::string& file) {
  std::optional<faults::FaultPlan> plan;
  if (!file.empty()) {
    auto read = faults::parse_plan_file(file);
    if (!read.ok())
      throw std::runtime_error(cast::render(read.diagnostics));
    plan = *read.plan;
  }
  set_log_level(LogLevel::debug);
  auto result = simulation.run(seed, plan);
  for (auto& x : result.history)
    fmt::print("entry {}: {}\n", x.entry, to_string(x));
  fmt::print("{}{}\n", lines(result.faults), result.ok() ? "all is well" : to_string(result));
}

} // namespace

} // namespace castor::simulation

int main(int argc, char** argv) {
  using namespace castor::simulation;
  CLI::App app{"Runs whole systems under schedules and with faults that follow from seeds, and "
               "checks that they recover and what their components saw."};
  std::string seeds = "1..10000";
  std::string state;
  std::optional<std::uint64_t> shown;
  std::string plan;
  bool expect_violation = false;
  app.add_option("--seeds", seeds, "which, FROM..TO")->capture_default_str();
  app.add_option("--state", state, "a file that knows how far it got; it goes on from there");
  app.add_option("--seed", shown, "print what happens with this one");
  app.add_option("--faults", plan, "with the faults of this file instead of its own")
    ->check(CLI::ExistingFile);
  app.add_flag("--expect-violation", expect_violation, "fail if all is well");
  CLI11_PARSE(app, argc, argv);
  SystemSimulation simulation;
  if (shown) {
    show(simulation, *shown, plan);
    return 0;
  }
  auto violated = run(simulation, parse_seeds(seeds), state);
  return violated.has_value() == expect_violation ? 0 : 1;
}
