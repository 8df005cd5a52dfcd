// How many messages a change event costs, if it is told to those who want it, and if it is told to
// everybody (`castor run --broadcast`): six subarchitectures over three nodes, one of which writes.
//
//   messages_benchmark [CHANGES]
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/node/node.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace castor::benchmark {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int node_count = 3;
constexpr int subarchitecture_count = 6;

struct Payload {
  std::string text;
};
CASTOR_REFLECT(Payload, text)

struct Finished {
  int changes = 0;
};
CASTOR_REFLECT(Finished, changes)

/// Few enough for none of them to be merged with another.
int changes = 2000;
double seconds = 0;

class Writer final : public UnmanagedComponent {
  void run() override {
    auto address = add(Payload{std::string(100, 'x')});
    auto begin = Clock::now();
    for (int i = 0; i < changes; ++i)
      overwrite(address, Payload{std::string(100, 'x')});
    seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    end_system(0, "done");
  }
};
CASTOR_COMPONENT(Writer, "changes an entry many times")

class Watcher final : public UnmanagedComponent {
  void start() override {
    on_change(overwritten<Payload>().anywhere(), [](const ChangeEvent&) {});
  }
};
CASTOR_COMPONENT(Watcher, "wants to hear of that")

ArchitectureDescription architecture(int watchers) {
  std::string text;
  for (int i = 0; i < subarchitecture_count; ++i) {
    text += fmt::format("SUBARCHITECTURE s{} node{}.test\nCPP WM SubarchitectureWorkingMemory\n"
                        "CPP TM AlwaysPositiveTaskManager\n",
                        i, i % node_count);
    if (i == 0)
      text += "CPP UM writer Writer\n";
    else if (i <= watchers)
      text += fmt::format("CPP UM watcher{} Watcher\n", i);
  }
  return cast::parse_string(text, "messages").architecture.value();
}

/// For each change.
struct Costs {
  double between_working_memories = 0;
  double over_links = 0;
  double bytes = 0;
  double changes_per_second = 0;
};

Costs measure(const std::map<std::string, Endpoint>& nodes, int watchers, bool broadcast) {
  SystemOptions options;
  options.nodes = nodes;
  options.broadcast = broadcast;
  System system{architecture(watchers), options};
  system.start();
  auto before = system.summary();
  system.wait({});
  system.stop();
  auto after = system.summary();
  auto bytes = [](const SystemSummary& x) {
    std::uint64_t result = 0;
    for (auto& process : x.processes)
      for (auto& link : process.links)
        result += link.bytes_out;
    return static_cast<double>(result);
  };
  Costs result;
  for (auto& process : after.processes)
    for (auto& link : process.links)
      result.over_links += static_cast<double>(link.events_out);
  for (auto& wm : after.working_memories)
    result.between_working_memories += static_cast<double>(wm.forwarded);
  result.between_working_memories /= changes;
  result.over_links /= changes;
  result.bytes = (bytes(after) - bytes(before)) / changes;
  result.changes_per_second = changes / seconds;
  return result;
}

int run() {
  set_log_level(LogLevel::off);
  std::vector<std::unique_ptr<Node>> nodes;
  std::map<std::string, Endpoint> addresses;
  for (int i = 0; i < node_count; ++i) {
    NodeOptions options;
    options.name = fmt::format("node{}.test", i);
    options.socket = listen_at({"127.0.0.1", 0});
    addresses[options.name] = {"127.0.0.1", port_of(options.socket)};
    nodes.push_back(std::make_unique<Node>(options));
  }
  fmt::print(
    "{} changes of an entry of 100 B, {} subarchitectures on {} nodes; for each change:\n\n"
    "{:<12} {:<12} {:>22} {:>12} {:>14} {:>12}\n",
    changes, subarchitecture_count, node_count, "wanted by", "scheme", "to working memories",
    "over links", "bytes on links", "changes/s");
  for (int watchers : {0, 1, 2, 3, subarchitecture_count - 1})
    for (bool broadcast : {false, true}) {
      auto x = measure(addresses, watchers, broadcast);
      fmt::print("{:<12} {:<12} {:>22.2f} {:>12.2f} {:>14.0f} {:>12.0f}\n", watchers,
                 broadcast ? "broadcast" : "distributed", x.between_working_memories, x.over_links,
                 x.bytes, x.changes_per_second);
    }
  return 0;
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  if (argc > 1)
    castor::benchmark::changes = std::atoi(argv[1]);
  return castor::benchmark::run();
}
