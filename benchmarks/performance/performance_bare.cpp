// What the bare actor framework costs; one measurement of scripts/bench at a time.
#include "castor/benchmarks/bare_config.hpp"
#include "castor/benchmarks/own_process.hpp"
#include "castor/benchmarks/performance/measurement.hpp"
#include "castor/benchmarks/performance/pipeline.hpp"
#include "castor/benchmarks/race.hpp"

#include <caf/io/middleman.hpp>
#include <caf/scoped_actor.hpp>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace castor::benchmark {

namespace {

struct BareNetworkConfig : BareConfig {
  BareNetworkConfig() { load<caf::io::middleman>(); }
};

/// Keeps what it was sent last.
caf::behavior store(caf::stateful_actor<std::string>* self) {
  return {[self](std::string& x) {
    self->state = std::move(x);
    return std::uint64_t{1};
  }};
}

/// Requests that carry a payload of `bytes`, with `in_flight` under way.
double request_rate(caf::actor_system& system, const caf::actor& server, const Arguments& x) {
  caf::scoped_actor self{system};
  auto bytes = x.count("bytes");
  auto in_flight = x.count("in_flight");
  std::vector<std::string> payloads;
  Race race{1};
  return race.measure_for(
    x.duration(), 0, batch_of(bytes),
    [&] { payloads.assign(batch_of(bytes), std::string(bytes, 'x')); },
    [&] {
      pipelined(
        payloads, in_flight,
        [&](std::string& payload) {
          return self->request(server, caf::infinite, std::move(payload));
        },
        [](auto& pending) {
          pending.receive([](std::uint64_t) {}, [](const caf::error&) { std::abort(); });
        });
    });
}

/// Within one process: figure `rate`.
void measure_writes(const Arguments& x) {
  BareConfig config;
  caf::actor_system system{config};
  auto server = system.spawn(store);
  print_figure("rate", request_rate(system, server, x));
  caf::anon_send_exit(server, caf::exit_reason::user_shutdown);
}

/// To another process: figure `rate`.
void measure_link_writes(const Arguments& x) {
  OwnProcess process{{"--serve"}};
  BareNetworkConfig config;
  caf::actor_system system{config};
  auto port = static_cast<std::uint16_t>(std::stoi(process.first_line()));
  auto server = *system.middleman().remote_actor("127.0.0.1", port);
  print_figure("rate", request_rate(system, server, x));
}

int serve() {
  BareNetworkConfig config;
  caf::actor_system system{config};
  auto port = *system.middleman().publish(system.spawn(store), 0, "127.0.0.1");
  std::printf("%d\n", port);
  std::fflush(stdout);
  await_end_of_input();
  std::_Exit(0);
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  if (argc == 2 && argv[1] == std::string{"--serve"})
    return serve();
  return run_measurement(argc, argv,
                         {{"writes", measure_writes}, {"link_writes", measure_link_writes}});
}
