// How long a guarded robot drives on after a failure, until it brakes and until it stands, and how
// far it gets.
//
//   safety_benchmark FILE [TIMES [KIND]]
//
// The robot drives a circle at 0.5 m/s, and brakes with 0.8 m/s^2. It, its laser, its guard, its
// driver, and the working memory with the driver's seat are in nodes of their own, processes of
// this program on 127.0.0.1. Each kind of failure is injected TIMES (100) times, at random moments.
// FILE keeps every injection: what it holds already is not repeated, so that a run may be
// interrupted. Several may run at a time, each with a KIND and a FILE of its own: with TIMES 0,
// the table of their files together is printed.
//
// Exit status: 0 if no stop was later than the bound by more than its processes had waited for a
// processor, 1 otherwise.
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/base/log.hpp"
#include "castor/benchmarks/safety/failure_kinds.hpp"
#include "castor/benchmarks/safety/guarded_circle.hpp"
#include "castor/benchmarks/safety/processor_wait.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <random>
#include <string>

#include <unistd.h>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds patience = 10s;

/// Of those that the time until the robot brakes depends on.
ProcessorWait wait_of(const CircleSystem& x) {
  std::vector<pid_t> result;
  for (const auto* node : {"base", "guarding", "sensing"})
    result.push_back(x.processes.at(node).id());
  return ProcessorWait{result};
}

Injection inject(const FailureKind& kind, const CircleSystem& x, std::int64_t phase) {
  auto& watch = circle_watch();
  watch.await_cruise(circle_speed);
  watch.await(x.system.now().count() + phase);
  const auto wait = wait_of(x);
  const auto begin = x.system.now().count();
  kind.fail(x);
  watch.await_braking(begin);
  Injection result{kind.name, {}, milliseconds(wait.since())};
  result.stop = watch.await_stop(begin, circle_braking);
  kind.mend(x);
  return result;
}

/// @param done number of injections before
void measure(const FailureKind& kind, int done, int times, const std::filesystem::path& folder,
             const std::filesystem::path& file) {
  std::map<std::string, NodeProcess> processes;
  SystemOptions options;
  options.link = link_options(patience);
  for (const auto& name : circle_nodes())
    options.nodes[name] = processes.try_emplace(name, name, patience).first->second.endpoint();
  circle_watch().clear();
  auto parsed = cast::parse_string(guarded_circle(folder), "benchmark");
  System system{*parsed.architecture, options};
  system.start();
  const auto numbers = place(*parsed.architecture, options.nodes).hosts;
  const CircleSystem circle{system, processes, {numbers.begin(), numbers.end()}};
  std::mt19937_64 random{static_cast<std::uint64_t>(done)};
  // From one scan to the next.
  std::uniform_int_distribution<std::int64_t> phase{0, 100'000};
  for (int i = done; i < times; ++i)
    append(inject(kind, circle, phase(random)), file);
  system.stop();
}

/// Whether no stop was too late.
bool print(const std::vector<Injection>& injections) {
  fmt::print("{:<34}{:>5}{:>11}{:>6}{:>12}{:>6}{:>9}{:>7}{:>6}{:>9}{:>8}{:>12}\n", "ms, m", "n",
             "brakes: p50", "max", "stands: p50", "max", "way: p50", "max", "late", "by load",
             "waited", "collisions");
  bool result = true;
  const auto summaries = summarise(injections);
  for (const auto& kind : failure_kinds()) {
    const auto i = summaries.find(kind.name);
    if (i == summaries.end())
      continue;
    const auto& x = i->second;
    fmt::print("{:<34}{:>5}{:>11.0f}{:>6.0f}{:>12.0f}{:>6.0f}{:>9.3f}{:>7.3f}{:>6}{:>9}{:>8.0f}"
               "{:>12}\n",
               kind.name, x.count, x.braked_p50, x.braked_max, x.stood_p50, x.stood_max, x.way_p50,
               x.way_max, x.late, x.late_by_load, x.waited_max, x.collisions);
    result = result && x.late == 0;
  }
  return result;
}

int run(const std::filesystem::path& file, int times, const std::string& wanted) {
  const auto before = summarise(read_injections(file));
  const auto folder =
    std::filesystem::temp_directory_path() / ("safety_benchmark-" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  for (const auto& kind : failure_kinds()) {
    const auto i = before.find(kind.name);
    const int done = i == before.end() ? 0 : static_cast<int>(i->second.count);
    if (done < times && kind.name.find(wanted) != std::string::npos)
      measure(kind, done, times, folder, file);
  }
  std::filesystem::remove_all(folder);
  return print(read_injections(file)) ? 0 : 1;
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  castor::set_log_level(castor::LogLevel::off);
  if (is_node_process(argc, argv)) {
    obey_laser_signals();
    return serve_as_node(argv);
  }
  if (argc < 2) {
    fmt::print(stderr, "usage: safety_benchmark FILE [TIMES [KIND]]\n");
    return 2;
  }
  try {
    return run(argv[1], argc > 2 ? std::max(0, std::atoi(argv[2])) : 100, argc > 3 ? argv[3] : "");
  } catch (const std::exception& e) {
    fmt::print(stderr, "safety_benchmark: {}\n", e.what());
    return 2;
  }
}
