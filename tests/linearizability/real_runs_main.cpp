#include "castor/tests/linearizability/real_run.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <cstdio>

int main(int argc, char** argv) {
  using namespace castor::linearizability;
  CLI::App app{"Runs systems whose components operate on a few entries at random, and checks what "
               "they saw."};
  std::uint64_t runs = 20;
  std::uint64_t seed = 1;
  bool show = false;
  app.add_option("--runs", runs, "how many")->capture_default_str();
  app.add_option("--seed", seed, "of the first; the next runs have the next ones")
    ->capture_default_str();
  app.add_flag("--show", show, "print the histories");
  CLI11_PARSE(app, argc, argv);
  auto begin = std::chrono::steady_clock::now();
  std::uint64_t operations = 0;
  std::uint64_t undecided = 0;
  for (auto i = seed; i < seed + runs; ++i) {
    auto result = run_for_real(i);
    operations += result.history.size();
    undecided += result.verdict.kind == Verdict::Kind::undecided;
    if (show || result.is_wrong())
      for (auto& x : result.history)
        fmt::print("entry {}: {}\n", x.entry, to_string(x));
    if (!result.is_wrong())
      continue;
    fmt::print("seed {} ({}):\n", i, result.description);
    for (auto& x : result.findings)
      fmt::print("{}\n", x);
    fmt::print("{}\n", result.verdict.report);
    return 1;
  }
  std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  fmt::print("{} runs of {:.0f} operations, {} undecided, {:.1f}/s\n", runs,
             double(operations) / double(runs), undecided, double(runs) / elapsed.count());
}
