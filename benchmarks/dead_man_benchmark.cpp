// How long an effector goes on after its commander is gone: from the failure until the wheel stands
// still, or obeys another; and whether a commander is ever obeyed again after that.
//
//   dead_man_benchmark [TIMES [CASE]]
//
// The wheel and the working memory are in this process, two commanders in nodes of their own,
// processes of this program on 127.0.0.1. Whoever holds the lease commands every 10 ms, and each
// command is valid for 100 ms.
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/system/fault_port.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"
#include "castor/benchmarks/node_process.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds valid_for = 100ms;
constexpr std::chrono::milliseconds lease = 400ms;
constexpr std::chrono::milliseconds outage = 1500ms;
constexpr std::chrono::milliseconds patience = 10s;

struct Turn {
  std::string commander;
};
CASTOR_REFLECT(Turn, commander)

struct Wheelhouse {};
CASTOR_REFLECT(Wheelhouse)

// -- what the wheel does

/// Whom the wheel obeys, and since when.
class Witness {
public:
  void obeys(const std::string& commander) {
    std::lock_guard guard{mutex_};
    if (commander != obeyed_) {
      obeyed_ = commander;
      since_ = Clock::now();
      changed_.notify_all();
    }
    ++commands_;
  }

  void rests() { obeys(""); }

  /// Waits until somebody has been obeyed for a while.
  std::string await_commander() {
    std::unique_lock guard{mutex_};
    wait(guard, [&] { return !obeyed_.empty(); });
    auto commands = commands_;
    wait(guard, [&] { return commands_ > commands + 5 && !obeyed_.empty(); });
    return obeyed_;
  }

  /// When that commander was obeyed no more.
  Clock::time_point await_end(const std::string& commander) {
    std::unique_lock guard{mutex_};
    wait(guard, [&] { return obeyed_ != commander; });
    return since_;
  }

private:
  template <class F>
  void wait(std::unique_lock<std::mutex>& guard, F&& f) {
    auto until = Clock::now() + 60s;
    while (!f())
      if (changed_.wait_until(guard, std::min(until, Clock::now() + 5ms)) ==
            std::cv_status::timeout &&
          Clock::now() >= until) {
        std::fputs("dead_man_benchmark: nothing has changed for a minute\n", stderr);
        std::_Exit(1);
      }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::string obeyed_;
  Clock::time_point since_;
  std::uint64_t commands_ = 0;
};

Witness witness;

// -- the components

class Wheel final : public StandaloneComponent {
  void start() override {
    on_command<Turn>([](const Turn& x) { witness.obeys(x.commander); }, [] { witness.rests(); },
                     {valid_for, Address{"a", "wheelhouse"}});
  }
};
CASTOR_COMPONENT(Wheel, "obeys")

class Builder final : public UnmanagedComponent {
  void start() override { add(here("wheelhouse"), Wheelhouse{}); }
};
CASTOR_COMPONENT(Builder, "adds the entry whose lease the wheel demands")

class Driver final : public UnmanagedComponent {
  void run() override {
    while (is_running()) {
      try {
        auto guard = lock(here("wheelhouse"), LockLevel::o, 1h);
        while (sleep_for(10ms))
          stream_command("wheel", Turn{component_name()});
      } catch (const ConnectionError&) {
        // It has lost the lease, or the wheel is out of reach: once more.
      } catch (const WorkingMemoryException&) {
        sleep_for(10ms);
      }
    }
  }
};
CASTOR_COMPONENT(Driver, "commands the wheel while it holds the lease")

// -- the measurement

struct Nodes {
  System& system;
  std::map<std::string, NodeProcess>& processes;
  /// The commander's node.
  std::string node;
  std::string commander;

  NodeProcess& process() const { return processes.at(node); }
  ProcessNumber number() const { return node == "one" ? 1 : 2; }
};

struct Case {
  const char* name;
  std::function<void(const Nodes&)> fail;
  std::function<void(const Nodes&)> mend = [](const Nodes&) {};
};

void measure(const Case& x, int times) {
  std::map<std::string, NodeProcess> processes;
  SystemOptions options;
  options.link = link_options(patience);
  std::string hosts;
  for (std::string name : {"one", "two"}) {
    auto& node = processes.try_emplace(name, name, patience).first->second;
    options.nodes[name] = node.endpoint();
    hosts += "HOSTNAME " + name + ' ' + name + '\n';
  }
  auto parsed = cast::parse_string(hosts +
                                     "SUPERVISE * RESTARTS 1000000 IN 1s DELAY 0ms TO 0ms\n"
                                     "COMPONENT CPP wheel Wheel\n"
                                     "SUBARCHITECTURE a localhost\n"
                                     "CPP WM SubarchitectureWorkingMemory --lease " +
                                     std::to_string(lease.count()) +
                                     "ms\n"
                                     "CPP TM AlwaysPositiveTaskManager\n"
                                     "CPP UM builder Builder\n"
                                     "[one] CPP UM first Driver\n"
                                     "[two] CPP UM second Driver\n",
                                   "benchmark");
  std::vector<double> ends;
  int again = 0;
  {
    System system{parsed.architecture.value(), options};
    system.start();
    for (int i = 0; i < times; ++i) {
      auto commander = witness.await_commander();
      Nodes nodes{system, processes, commander == "first" ? "one" : "two", commander};
      auto begin = Clock::now();
      x.fail(nodes);
      ends.push_back(milliseconds(witness.await_end(commander) - begin));
      // The other one takes over.
      auto next = witness.await_commander();
      x.mend(nodes);
      again += next == commander ? 1 : 0;
    }
    system.stop();
  }
  fmt::print("{:<28}{:>7}{:>12.1f}{:>10.1f}{:>10.1f}{:>14.1f}{:>12}\n", x.name, ends.size(),
             percentile(ends, 50), percentile(ends, 99), percentile(ends, 100),
             percentile(ends, 99) - milliseconds(valid_for), again);
  std::fflush(stdout);
}

std::vector<Case> cases() {
  return {
    {"crash of the component",
     [](const Nodes& x) { x.system.faults().inject(x.commander, ComponentFault{}); }},
    {"kill -9 of its node", [](const Nodes& x) { x.process().kill(); },
     [](const Nodes& x) { x.process().start(); }},
    {"SIGSTOP of its node", [](const Nodes& x) { x.process().signal(SIGSTOP); },
     [](const Nodes& x) { x.process().signal(SIGCONT); }},
    {"link cut",
     [](const Nodes& x) {
       x.system.faults().inject(0, x.number(), LinkFault{LinkFault::Kind::silence, outage});
     }},
  };
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  castor::set_log_level(castor::LogLevel::off);
  if (is_node_process(argc, argv))
    return serve_as_node(argv);
  auto times = argc > 1 ? std::max(1, std::atoi(argv[1])) : 100;
  fmt::print("{:<28}{:>7}{:>12}{:>10}{:>10}{:>14}{:>12}\n", "ms from the failure", "times",
             "still: p50", "p99", "max", "p99 - valid", "no change");
  for (auto& x : cases())
    if (argc < 3 || std::string{x.name}.find(argv[2]) != std::string::npos)
      measure(x, times);
}
