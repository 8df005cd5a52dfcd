// What operations on working memory cost, as ratios to bare blocking requests of the actor
// framework with the same payload and as many clients, measured in the same run; and how long an
// overwrite takes to another component's callback.
//
//   working_memory_benchmark [REPETITIONS]
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/caf.hpp"
#include "castor/base/log.hpp"
#include "castor/benchmarks/bare_config.hpp"
#include "castor/benchmarks/race.hpp"

#include <caf/scoped_actor.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;

struct Payload {
  std::string text;
};
CASTOR_REFLECT(Payload, text)

/// As the original's figures: many small entries, fewer large ones.
struct Size {
  const char* name;
  std::size_t bytes;
  std::size_t operations;
};
constexpr Size sizes[] = {{"100 B", 100, 5000}, {"64 KB", 65536, 400}};

const std::vector<int> client_counts{1, 4, 16};

/// What the running measurement is about, and what has come of it.
struct Task {
  Size size{};
  std::string target;
  std::unique_ptr<Race> race;
  std::vector<std::pair<std::string, double>> rates;
} task;

class Operator final : public UnmanagedComponent {
  void run() override {
    const auto n = task.size.operations;
    const auto me = index_.get();
    std::vector<Address> addresses(n);
    std::vector<Payload> payloads;
    std::size_t made = 0;
    auto prepare_payloads = [&] { payloads.assign(n, Payload{std::string(task.size.bytes, 'x')}); };
    auto nothing = [] {};
    auto race = [&](const char* name, const std::function<void()>& prepare,
                    const std::function<void()>& work) {
      auto rate = task.race->measure(static_cast<int>(me), n, prepare, work);
      if (me == 0)
        task.rates.emplace_back(name, rate);
    };
    race("add", prepare_payloads, [&] {
      for (std::size_t i = 0; i < n; ++i) {
        addresses[i] = {task.target, "e" + std::to_string(me) + ":" + std::to_string(made++)};
        add(addresses[i], std::move(payloads[i]));
      }
    });
    auto overwrite_first = [&] {
      for (auto& x : payloads)
        overwrite(addresses.front(), std::move(x));
    };
    race("overwrite", prepare_payloads, overwrite_first);
    race("overwrite, lock held", prepare_payloads, [&] {
      auto guard = lock(addresses.front(), LockLevel::o);
      overwrite_first();
    });
    race("read", nothing, [&] {
      for (auto& x : addresses)
        read<Payload>(x);
    });
    race("lock and unlock", nothing, [&] {
      for (auto& x : addresses)
        lock(x, LockLevel::odr).unlock();
    });
    // Adds first what is deleted then.
    race(
      "delete",
      [&] {
        for (auto& x : addresses)
          add(x = {task.target, "d" + std::to_string(me) + ":" + std::to_string(made++)},
              Payload{std::string(task.size.bytes, 'x')});
      },
      [&] {
        for (auto& x : addresses)
          delete_entry(x);
      });
    if (me == 0) {
      const Address contended{task.target, "contended"};
      add(contended, Payload{});
    }
    race("lock and unlock one entry", nothing, [&] {
      for (std::size_t i = 0; i < n; ++i)
        lock({task.target, "contended"}, LockLevel::odr, 1h).unlock();
    });
    if (me == 0)
      end_system(0, "done");
  }

  Option<std::int64_t> index_{this, "index", 0, "which of the operators this is"};
};

CASTOR_COMPONENT(Operator, "measures operations")

std::atomic<Clock::rep> written{0};
std::atomic<int> seen{0};
std::vector<double> latencies_us;

class Listener final : public UnmanagedComponent {
  void start() override {
    on_change(overwritten<Payload>().anywhere(), [](const ChangeEvent&) {
      auto now = Clock::now().time_since_epoch().count();
      latencies_us.push_back(static_cast<double>(now - written) / 1e3);
      ++seen;
    });
  }
};

CASTOR_COMPONENT(Listener, "measures when it hears")

class Teller final : public UnmanagedComponent {
  void run() override {
    auto address = add(Payload{});
    for (int i = 0; i < 1000 * repetitions; ++i) {
      Payload payload{std::string(task.size.bytes, 'x')};
      written = Clock::now().time_since_epoch().count();
      overwrite(address, std::move(payload));
      while (seen <= i)
        std::this_thread::yield();
      sleep_for(300us);
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

/// Blocking requests to one pooled actor, under the same scheduler settings, that carry the payload
/// there (the message is shared, as a value is).
double bare_request_rate(const Size& size, int clients) {
  BareConfig config;
  caf::actor_system system{config};
  auto server = system.spawn([](caf::event_based_actor*) -> caf::behavior {
    return {[](std::uint64_t x, const std::string&) { return x + 1; }};
  });
  double result = 0;
  Race race{clients};
  std::vector<std::thread> threads;
  for (int i = 0; i < clients; ++i)
    threads.emplace_back([&, i] {
      caf::scoped_actor self{system};
      std::vector<std::string> payloads;
      auto rate = race.measure(
        i, size.operations, [&] { payloads.assign(size.operations, std::string(size.bytes, 'x')); },
        [&] {
          for (auto& x : payloads)
            self->request(server, caf::infinite, std::uint64_t{0}, std::move(x))
              .receive([](std::uint64_t) {}, [](const caf::error&) { std::abort(); });
        });
      if (i == 0)
        result = rate;
    });
  for (auto& x : threads)
    x.join();
  caf::anon_send_exit(server, caf::exit_reason::user_shutdown);
  return result;
}

using Rates = std::vector<std::pair<std::string, double>>;

Rates operation_rates(const Size& size, const std::string& target, int clients) {
  task.size = size;
  task.target = target;
  task.race = std::make_unique<Race>(clients);
  task.rates.clear();
  auto components = subarchitecture("other") + subarchitecture("own");
  for (int i = 0; i < clients; ++i)
    components += fmt::format("CPP UM operator{} Operator --index {} --deadline 1h\n", i, i);
  run(components);
  return task.rates;
}

void report_operations() {
  for (auto& size : sizes) {
    std::vector<double> bare;
    for (auto clients : client_counts)
      bare.push_back(bare_request_rate(size, clients));
    fmt::print("\n{:<34}", fmt::format("{}, ops/s (ratio to bare)", size.name));
    for (auto clients : client_counts)
      fmt::print("{:>20}", fmt::format("{} component{}", clients, clients == 1 ? "" : "s"));
    fmt::print("\n{:<34}", "bare request of the framework");
    for (auto x : bare)
      fmt::print("{:>12.0f} {:>7}", x, "");
    fmt::print("\n");
    for (std::string target : {"own", "other"}) {
      std::vector<Rates> columns;
      for (auto clients : client_counts)
        columns.push_back(operation_rates(size, target, clients));
      for (std::size_t row = 0; row < columns.front().size(); ++row) {
        fmt::print("{:<34}", target + ": " + columns.front()[row].first);
        for (std::size_t i = 0; i < columns.size(); ++i)
          fmt::print("{:>12.0f} {:>7}", columns[i][row].second,
                     fmt::format("({:.1f})", columns[i][row].second / bare[i]));
        fmt::print("\n");
        std::fflush(stdout);
      }
    }
  }
}

void report_latency() {
  fmt::print("\n{:<34}{:>12}{:>12}\n", "overwrite to callback, us", "median", "99 %");
  for (auto& size : sizes)
    for (bool same : {true, false}) {
      task.size = size;
      latencies_us.clear();
      seen = 0;
      run(subarchitecture("a") + "CPP UM listener Listener\n" + (same ? "" : subarchitecture("b")) +
          "CPP UM teller Teller\n");
      std::sort(latencies_us.begin(), latencies_us.end());
      fmt::print("{:<34}{:>12.1f}{:>12.1f}\n",
                 fmt::format("{}, {} subarchitecture", size.name, same ? "same" : "other"),
                 median(latencies_us), latencies_us[latencies_us.size() * 99 / 100]);
    }
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  if (argc > 1)
    castor::benchmark::repetitions = std::max(1, std::atoi(argv[1]));
  castor::set_log_level(castor::LogLevel::warning);
  castor::benchmark::report_operations();
  castor::benchmark::report_latency();
}
