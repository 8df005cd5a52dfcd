#include "castor/base/log.hpp"
#include "castor/tests/tools/linearizability/node_runs.hpp"
#include "castor/tests/tools/linearizability/real_run.hpp"
#include "castor/tools/cli/progress.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace castor::linearizability {

namespace {

void print(std::uint64_t seed, const RealRunResult& x) {
  fmt::print("seed {} ({}):\n", seed, x.description);
  for (auto& finding : x.findings)
    fmt::print("{}\n", finding);
  fmt::print("{}\n", x.verdict.report);
}

} // namespace

} // namespace castor::linearizability

int main(int argc, char** argv) {
  using namespace castor::linearizability;
  CLI::App app{"Runs systems whose components operate on a few entries at random, and checks what "
               "they saw."};
  std::uint64_t runs = 20;
  std::uint64_t seed = 1;
  int nodes = 0;
  bool faults = false;
  std::int64_t longest_fault_ms = 1500;
  bool show = false;
  bool expect_violation = false;
  std::int64_t patience_ms = ample_patience.count();
  std::string serves_as;
  NodeRunOptions options;
  app.add_option("--runs", runs, "how many")->capture_default_str();
  app.add_option("--seed", seed, "of the first; the next runs have the next ones")
    ->capture_default_str();
  app.add_option("--nodes", nodes, "spread the systems over this process and 3 others")
    ->check(CLI::IsMember({0, 3}));
  app.add_flag("--faults", faults, "with --nodes: processes and connections fail");
  CLI::AsNumberWithUnit duration{std::map<std::string, std::int64_t>{{"ms", 1}, {"s", 1000}}};
  app.add_option("--longest-fault", longest_fault_ms, "with --faults: for how long")
    ->transform(duration);
  app.add_option("--patience", patience_ms, "with --nodes: who is out of reach for longer is lost")
    ->transform(duration);
  app
    .add_option("--tls", options.certificates,
                "with --nodes: encrypt, with what `scripts/make-certs DIR run node1 node2 node3` "
                "has made")
    ->type_name("DIR");
  app.add_flag("--show", show, "print the histories");
  app.add_flag("--expect-violation", expect_violation, "it is an error if there is none");
  app.add_option("--serve", serves_as, "be the node of that name")->group("");
  CLI11_PARSE(app, argc, argv);
  options.patience = std::chrono::milliseconds{patience_ms};
  if (!serves_as.empty())
    serve(serves_as, options);

  std::optional<NodeRuns> over_nodes;
  std::function<RealRunResult(std::uint64_t)> run = run_for_real;
  if (nodes > 0) {
    over_nodes.emplace("/proc/self/exe", options);
    std::optional<std::chrono::milliseconds> longest_fault;
    if (faults)
      longest_fault = std::chrono::milliseconds{longest_fault_ms};
    run = [&, longest_fault](std::uint64_t x) { return over_nodes->run(x, longest_fault); };
  }
  auto begin = std::chrono::steady_clock::now();
  std::uint64_t operations = 0;
  std::uint64_t pending = 0;
  std::uint64_t undecided = 0;
  castor::guard_log_lines(
    []() -> std::shared_ptr<void> { return std::make_shared<castor::cli::ProgressPause>(); });
  std::optional<castor::cli::Progress> progress{"runs"};
  for (auto i = seed; i < seed + runs; ++i) {
    progress->update(double(i - seed), double(runs),
                     fmt::format("seed {}, {} operations, {} undecided", i, operations, undecided));
    auto result = run(i);
    for (auto& x : result.history)
      if (x.kind != OperationKind::lapse) {
        ++operations;
        pending += x.pending();
      }
    const castor::cli::ProgressPause pause;
    if (result.verdict.kind == Verdict::Kind::undecided) {
      fmt::print("seed {} undecided: {}\n", i, result.verdict.report);
      ++undecided;
    }
    if (show || (result.is_wrong() && !expect_violation))
      for (auto& x : result.history)
        fmt::print("entry {}: {}\n", x.entry, to_string(x));
    if (!result.is_wrong())
      continue;
    print(i, result);
    return expect_violation ? 0 : 1;
  }
  progress.reset();
  std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  fmt::print("{} runs of {:.0f} operations, {:.1f} of them pending, {} undecided, {:.1f}/s\n", runs,
             double(operations) / double(runs), double(pending) / double(runs), undecided,
             double(runs) / elapsed.count());
  if (over_nodes)
    for (auto& [kind, times] : over_nodes->faults())
      fmt::print("{} times {}\n", times, to_string(kind));
  return expect_violation ? 1 : 0;
}
