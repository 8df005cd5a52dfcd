// What operations on working memory cost, as ratios to a bare blocking request of the actor
// framework measured in the same run, and how long a change takes to another component's callback.
//
//   working_memory_benchmark [REPETITIONS]
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/log.hpp"
#include "castor/actors/node/system.hpp"
#include "castor/actors/registry.hpp"
#include "castor/wm/caf.hpp"

#include <caf/atom.hpp>
#include <caf/scoped_actor.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace castor::benchmark {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// 100 bytes, the size that the original's figures are for.
struct Payload {
  std::string text = std::string(100, 'x');
};
CASTOR_REFLECT(Payload, text)

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x.empty() ? 0 : x[x.size() / 2];
}

int repetitions = 5;

/// Operations per second, by name; the medians of the repetitions.
std::map<std::string, double> rates;

std::vector<double> latencies_us;

double rate(std::size_t n, const std::function<void()>& work) {
  std::vector<double> all;
  for (int i = 0; i <= repetitions; ++i) {
    auto begin = Clock::now();
    work();
    auto seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    // The first is for warming up.
    if (i > 0)
      all.push_back(static_cast<double>(n) / seconds);
  }
  return median(all);
}

class Operator final : public UnmanagedComponent {
  void run() override {
    measure("own", subarchitecture());
    measure("other", "other");
    end_system(0, "done");
  }

  void measure(const std::string& where, const std::string& target) {
    constexpr std::size_t n = 20'000;
    std::vector<Address> addresses(n);
    std::size_t adds = 0;
    rates[where + " add"] = rate(n, [&] {
      for (auto& x : addresses)
        add(x = Address{target, "e" + std::to_string(adds++)}, Payload{});
    });
    auto first = addresses.front();
    rates[where + " overwrite"] = rate(n, [&] {
      for (std::size_t i = 0; i < n; ++i)
        overwrite(first, Payload{});
    });
    rates[where + " read"] = rate(n, [&] {
      for (auto& x : addresses)
        read<Payload>(x);
    });
    rates[where + " overwrite, 64 in flight"] = rate(n, [&] {
      std::vector<Pending<Version>> flying;
      for (std::size_t i = 0; i < n; ++i) {
        flying.push_back(overwrite_async(first, Payload{}));
        if (flying.size() == 64) {
          for (auto& x : flying)
            x.get();
          flying.clear();
        }
      }
      for (auto& x : flying)
        x.get();
    });
    std::size_t deletes = 0;
    rates[where + " delete"] = rate(n, [&] {
      for (std::size_t i = 0; i < n; ++i)
        delete_entry(Address{target, "e" + std::to_string(deletes++)});
    });
  }
};

CASTOR_COMPONENT(Operator, "measures operations")

std::atomic<Clock::rep> written{0};
std::atomic<int> seen{0};

class Listener final : public UnmanagedComponent {
  void start() override {
    on_change(changed<Payload>().anywhere(), [](const ChangeEvent&) {
      auto now = Clock::now().time_since_epoch().count();
      latencies_us.push_back(static_cast<double>(now - written) / 1e3);
      ++seen;
    });
  }
};

CASTOR_COMPONENT(Listener, "measures when it hears")

class Teller final : public UnmanagedComponent {
  void run() override {
    for (int i = 0; i < 3000; ++i) {
      written = Clock::now().time_since_epoch().count();
      add(Payload{});
      while (seen <= i)
        std::this_thread::yield();
      sleep_for(100us);
    }
    end_system(0, "done");
  }
};

CASTOR_COMPONENT(Teller, "makes changes")

std::string subarchitecture(const std::string& name) {
  return "SUBARCHITECTURE " + name +
         "\nCPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n";
}

void run(const std::string& components) {
  auto parsed = cast::parse_string("HOST localhost\nACCESS * WRITES *\n" + components, "benchmark");
  System system{parsed.architecture.value()};
  system.start();
  system.wait({});
  system.stop();
}

/// A blocking request to a pooled actor and its answer, under the same scheduler settings.
double bare_request_rate() {
  struct Config : caf::actor_system_config {
    Config() {
      set("scheduler.policy", caf::atom("sharing"));
      set("scheduler.max-threads", std::max<std::size_t>(2, std::thread::hardware_concurrency()));
    }
  };
  Config config;
  caf::actor_system system{config};
  auto server = system.spawn([](caf::event_based_actor*) -> caf::behavior {
    return {[](std::uint64_t x) { return x + 1; }};
  });
  double result = 0;
  {
    caf::scoped_actor self{system};
    constexpr std::size_t n = 20'000;
    result = rate(n, [&] {
      for (std::size_t i = 0; i < n; ++i)
        self->request(server, caf::infinite, std::uint64_t{i})
          .receive([](std::uint64_t) {}, [](const caf::error&) { std::abort(); });
    });
    self->send_exit(server, caf::exit_reason::user_shutdown);
  }
  return result;
}

int benchmark_main() {
  set_log_level(LogLevel::warning);
  auto bare = bare_request_rate();
  fmt::print("{:<34} {:>12} {:>8}\n", "", "ops/s", "ratio");
  fmt::print("{:<34} {:>12.0f} {:>8}\n", "bare request of the framework", bare, "1");
  run(subarchitecture("other") + subarchitecture("own") + "CPP UM operator Operator\n");
  for (auto& [name, x] : rates)
    fmt::print("{:<34} {:>12.0f} {:>8.1f}\n", name, x, x / bare);
  run(subarchitecture("a") + "CPP UM listener Listener\nCPP UM teller Teller\n");
  auto report = [](const char* what) {
    std::sort(latencies_us.begin(), latencies_us.end());
    fmt::print("{:<34} median {:.1f} us, 99 % {:.1f} us\n", what, median(latencies_us),
               latencies_us[latencies_us.size() * 99 / 100]);
    latencies_us.clear();
    seen = 0;
  };
  fmt::print("\n");
  report("change to callback, same subarch.");
  run(subarchitecture("a") + "CPP UM listener Listener\n" + subarchitecture("b") +
      "CPP UM teller Teller\n");
  report("change to callback, other subarch.");
  return 0;
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  if (argc > 1)
    castor::benchmark::repetitions = std::max(1, std::atoi(argv[1]));
  return castor::benchmark::benchmark_main();
}
