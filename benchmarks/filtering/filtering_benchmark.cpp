// What it costs that components hear of changes, in a system that a .cast file describes; one run of
// scripts/filtering-study. The file's components are Talkers, at `[node0]` to `[node9]` where they
// are in other processes.
//
//   filtering_benchmark changes system=FILE broadcast=0|1 nodes=N
#include "castor/base/log.hpp"
#include "castor/benchmarks/node_process.hpp"
#include "castor/benchmarks/performance/castor_system.hpp"
#include "castor/benchmarks/performance/process_cost.hpp"

#include <fmt/core.h>

#include <unistd.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;

std::mutex heard_mutex;
/// Microseconds from each change until a component of this process heard of it.
std::vector<double> heard;

/// Changes an entry of its own again and again, and hears of the changes that others make.
class Talker final : public UnmanagedComponent {
  void start() override {
    for (auto& name : hears_.get())
      on_change(changed<Payload>().anywhere().from(name), [this](const ChangeEvent& event) {
        heard_after_.push_back(static_cast<double>((now() - event.time).count()));
      });
  }

  void run() override {
    auto address = add(payload_of(100));
    for (std::int64_t i = 0; i < changes_ && sleep_for(pause_.get()); ++i)
      overwrite(address, payload_of(100));
  }

  void stop() override {
    std::lock_guard guard{heard_mutex};
    heard.insert(heard.end(), heard_after_.begin(), heard_after_.end());
  }

  std::vector<double> heard_after_;
  Option<std::vector<std::string>> hears_{this, "hears", {}, "components whose changes it wants"};
  Option<std::int64_t> changes_{this, "changes", 0, "how many changes it makes"};
  Option<std::chrono::milliseconds> pause_{this, "pause", 2ms, "time between them"};
};
CASTOR_COMPONENT(Talker, "changes an entry, and hears of what others change")

struct Counts {
  /// Of all working memories.
  double changes = 0, forwarded = 0, waiting = 0;
  /// Of all components.
  double deliveries = 0, rejected = 0, callbacks = 0;
  /// Of all links.
  double copies = 0, bytes = 0;

  friend bool operator==(const Counts&, const Counts&) = default;
};

Counts counts_of(const SystemSummary& summary) {
  Counts result;
  for (auto& x : summary.working_memories) {
    result.changes += static_cast<double>(x.events);
    result.forwarded += static_cast<double>(x.forwarded);
    result.waiting += static_cast<double>(x.backlog);
  }
  for (auto& x : summary.components) {
    result.deliveries += static_cast<double>(x.events_received);
    result.rejected += static_cast<double>(x.events_rejected);
    result.callbacks += static_cast<double>(x.callbacks);
  }
  for (auto& process : summary.processes)
    for (auto& link : process.links) {
      result.copies += static_cast<double>(link.events_out);
      result.bytes += static_cast<double>(link.bytes_out);
    }
  return result;
}

/// The counts when nothing has changed for a while. Links go on exchanging a few bytes.
Counts when_at_rest(System& system) {
  for (Counts last;;) {
    std::this_thread::sleep_for(500ms);
    auto now = counts_of(system.summary());
    last.bytes = now.bytes;
    if (now == last && now.changes > 0 && now.waiting == 0)
      return now;
    last = now;
  }
}

std::string content_of(const std::string& file) {
  std::ifstream in{file};
  if (!in)
    throw std::runtime_error("cannot read " + file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Figures for each change, but `changes`, their number, and `p50` and `p99` of the microseconds
/// until a component has heard, which are printed for a system of one process.
void measure_changes(const Arguments& x) {
  SystemOptions options;
  options.broadcast = x.count("broadcast") != 0;
  std::vector<std::unique_ptr<NodeProcess>> nodes;
  std::vector<pid_t> processes{getpid()};
  for (std::size_t i = 0; i < x.count("nodes"); ++i) {
    auto name = fmt::format("node{}", i);
    nodes.push_back(std::make_unique<NodeProcess>(name, 10s));
    processes.push_back(nodes.back()->id());
    options.nodes[name] = nodes.back()->endpoint();
  }
  auto processor = [&] {
    double result = 0;
    for (auto process : processes)
      result += processor_seconds(process);
    return result;
  };
  double before = 0;
  Counts counts;
  run_system(content_of(x.text("system")), options, [&](System& system) {
    before = processor();
    auto bytes_before = counts_of(system.summary()).bytes;
    counts = when_at_rest(system);
    print_figure("processor", 1e6 * (processor() - before) / counts.changes);
    print_figure("bytes", (counts.bytes - bytes_before) / counts.changes);
  });
  print_figure("changes", counts.changes);
  for (auto& [name, value] :
       {std::pair{"forwarded", counts.forwarded}, std::pair{"deliveries", counts.deliveries},
        std::pair{"rejected", counts.rejected}, std::pair{"callbacks", counts.callbacks},
        std::pair{"copies", counts.copies}})
    print_figure(name, value / counts.changes);
  if (nodes.empty() && !heard.empty())
    print_percentiles(heard);
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  castor::set_log_level(castor::LogLevel::warning);
  if (is_node_process(argc, argv))
    return serve_as_node(argv);
  return run_measurement(argc, argv, {{"changes", measure_changes}});
}
