// What systems cost in which nothing happens.
#include "castor/benchmarks/node_process.hpp"
#include "castor/benchmarks/performance/castor_measurements.hpp"
#include "castor/benchmarks/performance/castor_system.hpp"
#include "castor/benchmarks/performance/process_cost.hpp"

#include <fmt/core.h>

#include <unistd.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;

class Idler final : public UnmanagedComponent {
  void start() override {
    on_change(changed<Payload>(), [](const ChangeEvent&) {});
  }
};
CASTOR_COMPONENT(Idler, "waits for changes that never come")

class PooledIdler final : public CallbackComponent {
  void start() override {
    on_change(changed<Payload>(), [](const ChangeEvent&) {});
  }
};
CASTOR_COMPONENT(PooledIdler, "waits for changes that never come, without a thread")

/// Time after which nothing is left of the start.
constexpr auto settling = 5s;

/// Percent of a core that the processes take together, from now on.
double idle_percent(const std::vector<pid_t>& processes, std::chrono::duration<double> duration) {
  auto seconds = [&] {
    double result = 0;
    for (auto x : processes)
      result += processor_seconds(x);
    return result;
  };
  auto begin = Clock::now();
  auto before = seconds();
  std::this_thread::sleep_for(duration);
  auto used = seconds() - before;
  return 100 * used / std::chrono::duration<double>(Clock::now() - begin).count();
}

double memory_of(const std::vector<pid_t>& processes) {
  double result = 0;
  for (auto x : processes)
    result += memory_bytes(x);
  return result;
}

} // namespace

void measure_idle_mesh(const Arguments& x) {
  std::vector<std::unique_ptr<NodeProcess>> nodes;
  std::vector<pid_t> processes{getpid()};
  SystemOptions options;
  std::string text;
  for (std::size_t i = 0; i < x.count("nodes"); ++i) {
    auto name = fmt::format("node{}", i);
    nodes.push_back(std::make_unique<NodeProcess>(name, 10s));
    processes.push_back(nodes.back()->id());
    options.nodes[name] = nodes.back()->endpoint();
    text +=
      subarchitecture_text(fmt::format("s{}", i), name) + fmt::format("CPP UM idler{} Idler\n", i);
  }
  run_system(text, options, [&](System&) {
    std::this_thread::sleep_for(settling);
    print_figure("cpu", idle_percent(processes, x.duration()));
    print_figure("memory", memory_of(processes) / static_cast<double>(nodes.size()));
  });
}

void measure_idle_components(const Arguments& x) {
  auto count = x.count("components");
  auto text = subarchitecture_text("a");
  for (std::size_t i = 0; i < count; ++i)
    text += fmt::format("CPP UM idler{} {}\n", i, x.text("class"));
  auto memory_before = memory_bytes(getpid());
  auto begin = Clock::now();
  run_system(text, {}, [&](System&) {
    print_figure("start", std::chrono::duration<double>(Clock::now() - begin).count());
    std::this_thread::sleep_for(settling);
    print_figure("cpu", idle_percent({getpid()}, x.duration()));
    print_figure("memory", (memory_bytes(getpid()) - memory_before) / static_cast<double>(count));
  });
}

} // namespace castor::benchmark
