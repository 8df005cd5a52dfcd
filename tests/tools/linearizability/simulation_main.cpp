#include "castor/tools/cli/progress.hpp"
#include "castor/tools/simulation/memory_simulation.hpp"
#include "castor/tools/simulation/seeds.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace castor::linearizability {

namespace {

using castor::simulation::Seeds;

/// The number of the seed that something is wrong with, if there is one.
std::optional<std::uint64_t> run(Simulation& simulation, const Seeds& seeds) {
  auto begin = std::chrono::steady_clock::now();
  std::uint64_t operations = 0;
  std::uint64_t undecided = 0;
  auto histories = seeds.to - seeds.from + 1;
  std::optional<cli::Progress> progress{"simulation"};
  for (auto seed = seeds.from; seed <= seeds.to; ++seed) {
    if (progress->due())
      progress->update(double(seed - seeds.from), double(histories),
                       fmt::format("seed {}, {} undecided", seed, undecided));
    auto result = simulation.run(seed);
    operations += result.history.size();
    if (result.ok())
      continue;
    const cli::ProgressPause pause;
    if (result.is_wrong()) {
      fmt::print("seed {}:\n{}\n", seed, to_string(result));
      return seed;
    }
    fmt::print("seed {} undecided: {}\n", seed, result.verdict.report);
    ++undecided;
  }
  progress.reset();
  std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  fmt::print("{} histories of {:.0f} operations, {} undecided, {:.0f}/s\n", histories,
             double(operations) / double(histories), undecided,
             double(histories) / elapsed.count());
  return std::nullopt;
}

void show(Simulation& simulation, std::uint64_t seed) {
  auto result = simulation.run(seed);
  for (auto& x : result.history)
    fmt::print("entry {}: {}\n", x.entry, to_string(x));
  fmt::print("{}\n", result.ok() ? "all is well" : to_string(result));
}

} // namespace

} // namespace castor::linearizability

int main(int argc, char** argv) {
  using namespace castor::linearizability;
  CLI::App app{
    "Runs working memories and their clients under schedules that follow from seeds, and "
    "checks what the clients saw."};
  std::string seeds = "1..1000";
  std::optional<std::uint64_t> shown;
  bool expect_violation = false;
  app.add_option("--seeds", seeds, "which, FROM..TO")->capture_default_str();
  app.add_option("--seed", shown, "print the history of this one");
  app.add_flag("--expect-violation", expect_violation, "fail if all is well");
  CLI11_PARSE(app, argc, argv);
  Simulation simulation;
  if (shown) {
    show(simulation, *shown);
    return 0;
  }
  auto violated = run(simulation, castor::simulation::parse_seeds(seeds));
  return violated.has_value() == expect_violation ? 0 : 1;
}
