// What operations on the working memory of another process cost, as ratios to bare requests to an
// actor of another process over CAF's own network protocol, with the same payload and as many
// clients, measured in the same run; and how long an event takes from there.
//
//   remote_benchmark [--tls DIR] [REPETITIONS]
//
// With certificates that `scripts/make-certs DIR run far.test` has made, what Castor says is
// encrypted; the bare framework's requests are not.
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/node/node.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/caf.hpp"
#include "castor/base/log.hpp"
#include "castor/benchmarks/bare_config.hpp"
#include "castor/benchmarks/own_process.hpp"
#include "castor/benchmarks/race.hpp"

#include <caf/io/middleman.hpp>
#include <caf/scoped_actor.hpp>

#include <fmt/core.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
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

struct Size {
  const char* name;
  std::size_t bytes;
  std::size_t operations;
};
constexpr Size sizes[] = {{"100 B", 100, 2000}, {"64 KB", 65536, 300}, {"1 MB", 1 << 20, 30}};
constexpr std::size_t in_flight = 64;

const std::vector<int> client_counts{1, 4, 16};

/// The rows of the table, of Castor and of the bare framework.
const std::vector<std::string> rows{"overwrite", "read", "overwrite, 64 in flight"};
using Rates = std::vector<double>;

// -- Castor

struct Task {
  Size size{};
  std::unique_ptr<Race> race;
  Rates rates;
} task;

class Operator final : public UnmanagedComponent {
  void run() override {
    const auto n = task.size.operations;
    const auto me = static_cast<int>(index_.get());
    const Address address{"far", "e" + std::to_string(me)};
    add(address, Payload{});
    std::vector<Payload> payloads;
    auto prepare = [&] { payloads.assign(n, Payload{std::string(task.size.bytes, 'x')}); };
    auto race = [&](const std::function<void()>& work) {
      auto rate = task.race->measure(me, n, prepare, work);
      if (me == 0)
        task.rates.push_back(rate);
    };
    race([&] {
      for (auto& x : payloads)
        overwrite(address, std::move(x));
    });
    race([&] {
      for (std::size_t i = 0; i < n; ++i)
        read<Payload>(address);
    });
    race([&] {
      std::deque<Pending<Version>> pending;
      for (auto& x : payloads) {
        if (pending.size() == in_flight) {
          pending.front().get();
          pending.pop_front();
        }
        pending.push_back(overwrite_async(address, std::move(x)));
      }
      for (auto& x : pending)
        x.get();
    });
    if (me == 0)
      end_system(0, "done");
  }

  Option<std::int64_t> index_{this, "index", 0, "which of the operators this is"};
};
CASTOR_COMPONENT(Operator, "measures operations")

std::vector<double> latencies_us;

/// Overwrites an entry on the node, and waits until it hears of that from there.
class Echo final : public UnmanagedComponent {
  void run() override {
    Address address{"far", "echo"};
    add(address, Payload{});
    int heard = 0;
    Clock::time_point written;
    on_change(changes_of(address), [&](const ChangeEvent&) {
      latencies_us.push_back(
        std::chrono::duration<double, std::micro>(Clock::now() - written).count());
      ++heard;
    });
    for (int i = 0; i < 300 * repetitions; ++i) {
      Payload payload{std::string(task.size.bytes, 'x')};
      written = Clock::now();
      overwrite(address, std::move(payload));
      while (heard <= i)
        wait_for_changes();
    }
    end_system(0, "done");
  }
};
CASTOR_COMPONENT(Echo, "measures events")

/// The folder with the certificates; empty for none.
std::string tls;

std::optional<Credentials> credentials(const std::string& name) {
  if (tls.empty())
    return std::nullopt;
  return Credentials::load(tls + '/' + name);
}

void run(const Endpoint& node, const std::string& components) {
  auto parsed = cast::parse_string("ACCESS * WRITES *\nSUBARCHITECTURE far far.test\n"
                                   "CPP WM SubarchitectureWorkingMemory\n"
                                   "CPP TM AlwaysPositiveTaskManager\n"
                                   "SUBARCHITECTURE near localhost\n"
                                   "CPP WM SubarchitectureWorkingMemory\n"
                                   "CPP TM AlwaysPositiveTaskManager\n" +
                                     components,
                                   "benchmark");
  SystemOptions options;
  options.nodes["far.test"] = node;
  options.credentials = credentials("run");
  System system{parsed.architecture.value(), options};
  system.start();
  system.wait({});
  system.stop();
}

Rates castor_rates(const Endpoint& node, const Size& size, int clients) {
  task.size = size;
  task.race = std::make_unique<Race>(clients);
  task.rates.clear();
  std::string components;
  for (int i = 0; i < clients; ++i)
    components += fmt::format("CPP UM operator{} Operator --index {} --deadline 1h\n", i, i);
  run(node, components);
  return task.rates;
}

// -- the bare framework

using PutAtom = caf::atom_constant<caf::atom("put")>;
using GetAtom = caf::atom_constant<caf::atom("get")>;

struct BareNetworkConfig : BareConfig {
  BareNetworkConfig() { load<caf::io::middleman>(); }
};

caf::behavior bare_server(caf::stateful_actor<std::string>* self) {
  return {
    [self](PutAtom, std::string& x) {
      self->state = std::move(x);
      return std::uint64_t{1};
    },
    [self](GetAtom) { return self->state; },
  };
}

Rates bare_rates(std::uint16_t port, const Size& size, int clients) {
  BareNetworkConfig config;
  caf::actor_system system{config};
  auto server = *system.middleman().remote_actor("127.0.0.1", port);
  Rates result;
  Race race{clients};
  std::vector<std::thread> threads;
  for (int i = 0; i < clients; ++i)
    threads.emplace_back([&, i] {
      caf::scoped_actor self{system};
      std::vector<std::string> payloads;
      auto prepare = [&] { payloads.assign(size.operations, std::string(size.bytes, 'x')); };
      auto measure = [&](const std::function<void()>& work) {
        auto rate = race.measure(i, size.operations, prepare, work);
        if (i == 0)
          result.push_back(rate);
      };
      auto failed = [](const caf::error&) { std::abort(); };
      auto put = [&](std::string& x) {
        return self->request(server, caf::infinite, PutAtom::value, std::move(x));
      };
      measure([&] {
        for (auto& x : payloads)
          put(x).receive([](std::uint64_t) {}, failed);
      });
      measure([&] {
        for (std::size_t k = 0; k < size.operations; ++k)
          self->request(server, caf::infinite, GetAtom::value)
            .receive([](const std::string&) {}, failed);
      });
      measure([&] {
        std::deque<decltype(put(payloads.front()))> pending;
        auto take = [&] {
          pending.front().receive([](std::uint64_t) {}, failed);
          pending.pop_front();
        };
        for (auto& x : payloads) {
          if (pending.size() == in_flight)
            take();
          pending.push_back(put(x));
        }
        while (!pending.empty())
          take();
      });
    });
  for (auto& x : threads)
    x.join();
  return result;
}

// -- the other process

int serve() {
  NodeOptions options;
  options.name = "far.test";
  options.credentials = credentials("far.test");
  options.socket = listen_at({"127.0.0.1", 0});
  auto node_port = port_of(options.socket);
  Node node{options};
  BareNetworkConfig config;
  caf::actor_system system{config};
  auto server = system.spawn(bare_server);
  auto bare_port = *system.middleman().publish(server, 0, "127.0.0.1");
  std::printf("%d %d\n", node_port, bare_port);
  std::fflush(stdout);
  await_end_of_input();
  std::_Exit(0);
}

/// The process in which `serve` runs; ends with this object.
class Server {
public:
  Server() {
    if (std::sscanf(process_.first_line().c_str(), "%hu %hu", &node_port_, &bare_port_) != 2)
      std::abort();
  }

  Endpoint node() const { return {"127.0.0.1", node_port_}; }
  std::uint16_t bare_port() const { return bare_port_; }

private:
  OwnProcess process_{{"--serve", tls}};
  std::uint16_t node_port_ = 0;
  std::uint16_t bare_port_ = 0;
};

void report_operations(const Server& server) {
  for (auto& size : sizes) {
    std::vector<Rates> bare;
    std::vector<Rates> ours;
    for (auto clients : client_counts) {
      bare.push_back(bare_rates(server.bare_port(), size, clients));
      ours.push_back(castor_rates(server.node(), size, clients));
    }
    fmt::print("\n{:<34}", fmt::format("{}, ops/s (ratio to bare)", size.name));
    for (auto clients : client_counts)
      fmt::print("{:>20}", fmt::format("{} client{}", clients, clients == 1 ? "" : "s"));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      fmt::print("\n{:<34}", "bare: " + rows[row]);
      for (auto& x : bare)
        fmt::print("{:>12.0f} {:>7}", x[row], "");
      fmt::print("\n{:<34}", rows[row]);
      for (std::size_t i = 0; i < ours.size(); ++i)
        fmt::print("{:>12.0f} {:>7}", ours[i][row],
                   fmt::format("({:.2f})", ours[i][row] / bare[i][row]));
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
}

void report_events(const Server& server) {
  fmt::print("\n{:<34}{:>12}{:>12}{:>24}\n", "overwrite there to callback here, us", "median",
             "99 %", "ratio to a bare request");
  for (auto& size : sizes) {
    task.size = size;
    latencies_us.clear();
    run(server.node(), "CPP UM echo Echo --deadline 1h\n");
    std::sort(latencies_us.begin(), latencies_us.end());
    auto bare_us = 1e6 / bare_rates(server.bare_port(), size, 1).front();
    fmt::print("{:<34}{:>12.1f}{:>12.1f}{:>24.2f}\n", size.name, median(latencies_us),
               latencies_us[latencies_us.size() * 99 / 100], median(latencies_us) / bare_us);
  }
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  castor::set_log_level(castor::LogLevel::warning);
  if (argc > 2 && argv[1] == std::string{"--serve"}) {
    tls = argv[2];
    return serve();
  }
  if (argc > 2 && argv[1] == std::string{"--tls"}) {
    tls = argv[2];
    argc -= 2;
    argv += 2;
  }
  if (argc > 1)
    repetitions = std::max(1, std::atoi(argv[1]));
  Server server;
  report_operations(server);
  report_events(server);
}
