// How long change events take to other components of the process, and how many there can be.
#include "castor/benchmarks/performance/castor_measurements.hpp"
#include "castor/benchmarks/performance/castor_system.hpp"
#include "castor/benchmarks/performance/far_node.hpp"
#include "castor/benchmarks/performance/shared_page.hpp"

#include <fmt/core.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <thread>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;

/// Arguments of the running measurement.
const Arguments* task = nullptr;

/// Overwrites now and then, each time the former one has been heard.
class Teller final : public UnmanagedComponent {
  void run() override {
    SharedPage page{page_};
    auto address = add(Payload{});
    auto bytes = task->count("bytes");
    print_percentiles(measure_hearing(
      page, task->duration(), [&] { overwrite(address, payload_of(bytes)); },
      [&](std::chrono::nanoseconds x) { sleep_for(x); }));
    end_system(0, "done");
  }

  Option<std::string> page_{this, "page", "", "file that it shares with the listener"};
};
CASTOR_COMPONENT(Teller, "overwrites an entry and waits until that was heard")

class Listener final : public UnmanagedComponent {
  void start() override {
    page_.emplace(file_);
    on_change(overwritten<Payload>().anywhere(), [this](const ChangeEvent&) { page_->hear(); });
  }

  std::optional<SharedPage> page_;
  Option<std::string> file_{this, "page", "", "file that it shares with the teller"};
};
CASTOR_COMPONENT(Listener, "hears of overwrites")

/// With the listener at `host`.
void measure_latency(const Arguments& x, const std::string& host, const SystemOptions& options) {
  task = &x;
  auto file = SharedPage::make();
  run_system(subarchitecture_text("a") +
               fmt::format("[{}] CPP UM listener Listener --page {}\n", host, file.path()) +
               fmt::format("CPP UM teller Teller --page {}\n", file.path()),
             options);
}

// -- many listeners

std::atomic<std::uint64_t> callbacks{0};

class Counter final : public UnmanagedComponent {
  void start() override {
    on_change(overwritten<Payload>(), [](const ChangeEvent&) { ++callbacks; });
  }
};
CASTOR_COMPONENT(Counter, "counts overwrites")

class PooledCounter final : public CallbackComponent {
  void start() override {
    on_change(overwritten<Payload>(), [](const ChangeEvent&) { ++callbacks; });
  }
};
CASTOR_COMPONENT(PooledCounter, "counts overwrites, without a thread")

/// Overwrites without a pause, but so that no more than some hundred events wait for a listener.
class Announcer final : public UnmanagedComponent {
  void run() override {
    constexpr std::uint64_t most_waiting = 500;
    auto listeners = task->count("listeners");
    auto address = add(Payload{});
    std::uint64_t overwrites = 0;
    auto announce = [&] {
      overwrite(address, payload_of(task->count("bytes")));
      ++overwrites;
      while (callbacks + most_waiting * listeners < overwrites * listeners)
        std::this_thread::sleep_for(20us);
    };
    for (auto begin = Clock::now(); Clock::now() - begin < task->duration() / 4;)
      announce();
    auto overwrites_before = overwrites;
    auto callbacks_before = callbacks.load();
    auto begin = Clock::now();
    while (Clock::now() - begin < task->duration())
      announce();
    auto seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    print_figure("overwrites", static_cast<double>(overwrites - overwrites_before) / seconds);
    print_figure("callbacks", static_cast<double>(callbacks - callbacks_before) / seconds);
    end_system(0, "done");
  }
};
CASTOR_COMPONENT(Announcer, "overwrites an entry without a pause")

} // namespace

void measure_events(const Arguments& x) {
  measure_latency(x, "localhost", {});
}

void measure_fan_out(const Arguments& x) {
  task = &x;
  auto text = subarchitecture_text("a") + "CPP UM announcer Announcer --budget 1h\n";
  for (std::size_t i = 0; i < x.count("listeners"); ++i)
    text += fmt::format("CPP UM counter{} {}\n", i, x.text("class"));
  run_system(text);
}

void measure_link_events(const Arguments& x) {
  FarNode far;
  measure_latency(x, "far", far.options());
}

} // namespace castor::benchmark
