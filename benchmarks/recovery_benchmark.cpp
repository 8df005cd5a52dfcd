// How long a system is without something that has failed: from the failure until others see what
// the first callback of the next life wrote; and how much of that is over what the architecture
// allows.
//
//   recovery_benchmark [TIMES [CASE]]
//
// Nodes are processes of this program on 127.0.0.1.
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/fault_port.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"
#include "castor/benchmarks/node_process.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// -- the components

struct Beat {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Beat, number)

/// What a service says in its first callback.
struct Sign {
  std::int64_t beat = 0;
};
CASTOR_REFLECT(Sign, beat)

/// There is always something to react to.
class Heart final : public UnmanagedComponent {
  void run() override {
    auto beat = here("beat");
    add(beat, Beat{});
    for (std::int64_t i = 1; sleep_for(500us); ++i)
      overwrite(beat, Beat{i});
  }
};
CASTOR_COMPONENT(Heart, "beats")

/// Gives a sign in the first callback of each of its lives.
class Service final : public UnmanagedComponent {
  void start() override {
    on_change(overwritten<Beat>(), [this](const ChangeEvent& event) {
      if (std::exchange(was_called_, true))
        return;
      auto beat = read<Beat>(event.address);
      add(here(new_id()), Sign{beat->number});
    });
  }

  bool was_called_ = false;
};
CASTOR_COMPONENT(Service, "gives a sign of life")

/// Shows by its return that of its node.
class Bystander final : public UnmanagedComponent {};
CASTOR_COMPONENT(Bystander, "stands by")

constexpr std::chrono::milliseconds patience = 1s;

// -- the measurement

/// What is seen of a running system.
class Witness {
public:
  void see_sign() {
    note([this] { sign_ = Clock::now(); });
  }
  void see_down(const std::string& who) {
    note([&] { down_[who] = Clock::now(); });
  }
  void see_up(const std::string& who) {
    note([&] { up_[who] = Clock::now(); });
  }

  /// The moment of the first sign after `from`.
  Clock::time_point await_sign(Clock::time_point from) {
    return await([&] { return sign_; }, from);
  }
  Clock::time_point await_up(const std::string& who, Clock::time_point from) {
    return await([&] { return up_[who]; }, from);
  }

  /// When it was last noticed that something is not there.
  Clock::time_point down(const std::string& who) {
    std::lock_guard guard{mutex_};
    return down_[who];
  }

private:
  template <class F>
  void note(F&& f) {
    std::lock_guard guard{mutex_};
    f();
    changed_.notify_all();
  }

  template <class F>
  Clock::time_point await(F&& moment, Clock::time_point from) {
    std::unique_lock guard{mutex_};
    if (!changed_.wait_for(guard, 60s, [&] { return moment() > from; })) {
      std::fputs("recovery_benchmark: nothing has come back for a minute\n", stderr);
      std::_Exit(1);
    }
    return moment();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  Clock::time_point sign_;
  std::map<std::string, Clock::time_point> down_;
  std::map<std::string, Clock::time_point> up_;
};

struct Case {
  const char* name;
  /// What the architecture allows for it, without the work itself.
  std::chrono::milliseconds allowed;
  /// It takes so long that the n-th part of the times has to do.
  int share = 1;
  /// What the architecture says before the subarchitecture, and in it.
  std::string rules;
  std::string components;
  std::vector<std::string> nodes;
  /// What happens, to the service that runs at the first of the nodes, if there are any.
  std::function<void(System&, std::vector<NodeProcess*>&, Witness&)> fail;
  /// What has to be so before the next failure.
  std::function<void(std::vector<NodeProcess*>&, Witness&)> mend = [](auto&, auto&) {};
};

void measure(const Case& x, int times) {
  std::map<std::string, NodeProcess> processes;
  std::vector<NodeProcess*> nodes;
  std::string hosts;
  SystemOptions options;
  options.link = link_options(patience);
  for (auto& name : x.nodes) {
    auto& node = processes.try_emplace(name, name, patience).first->second;
    nodes.push_back(&node);
    options.nodes[name] = node.endpoint();
    hosts += "HOSTNAME " + name + ' ' + name + '\n';
  }
  Witness witness;
  options.on_down = [&](const ComponentDown& down) { witness.see_down(down.component); };
  options.on_up = [&](const ComponentUp& up) { witness.see_up(up.component); };
  options.on_change = [&](const ChangeEvent& event) {
    if (event.operation == Operation::add && event.type && event.type->name() == "Sign")
      witness.see_sign();
  };
  // A hung process does not end for a polite request.
  std::mutex mutex;
  std::condition_variable hung;
  bool over = false;
  bool is_hung = false;
  options.kill_child = [&](const std::string&, std::chrono::steady_clock::time_point) {
    std::lock_guard guard{mutex};
    is_hung = true;
    hung.notify_all();
    return true;
  };
  std::thread killer{[&] {
    std::unique_lock guard{mutex};
    while (hung.wait(guard, [&] { return over || is_hung; }), !over) {
      is_hung = false;
      nodes.front()->kill();
      nodes.front()->start();
    }
  }};
  auto parsed = cast::parse_string(hosts + x.rules +
                                     "SUPERVISE * RESTARTS 1000000 IN 1s DELAY 0ms TO 0ms\n"
                                     "SUBARCHITECTURE a localhost\n"
                                     "CPP WM SubarchitectureWorkingMemory\n"
                                     "CPP TM AlwaysPositiveTaskManager\n"
                                     "CPP UM heart Heart\n" +
                                     x.components,
                                   "benchmark");
  std::vector<double> noticed;
  std::vector<double> back;
  {
    System system{parsed.architecture.value(), options};
    system.start();
    witness.await_sign({});
    for (int i = 0; i < std::max(5, times / x.share); ++i) {
      auto begin = Clock::now();
      x.fail(system, nodes, witness);
      back.push_back(milliseconds(witness.await_sign(begin) - begin));
      noticed.push_back(milliseconds(witness.down("service") - begin));
      x.mend(nodes, witness);
    }
    system.stop();
  }
  {
    std::lock_guard guard{mutex};
    over = true;
    hung.notify_all();
  }
  killer.join();
  auto p50 = percentile(back, 50);
  auto p99 = percentile(back, 99);
  auto allowed = static_cast<double>(x.allowed.count());
  fmt::print("{:<44}{:>7}{:>9.0f}{:>11.1f}{:>11.1f}{:>10.1f}{:>10.1f}{:>12.1f}\n", x.name,
             back.size(), allowed, percentile(noticed, 50), p50, p99, percentile(back, 100),
             p99 - allowed);
  std::fflush(stdout);
}

void crash(System& system, std::vector<NodeProcess*>&, Witness&) {
  system.faults().inject("service", ComponentFault{});
}

void hang(System& system, std::vector<NodeProcess*>&, Witness&) {
  ComponentFault fault{ComponentFault::Kind::hang};
  fault.by = 1h;
  system.faults().inject("service", fault);
}

void kill_first(System&, std::vector<NodeProcess*>& nodes, Witness&) {
  nodes.front()->kill();
}

void kill_and_start_first(System&, std::vector<NodeProcess*>& nodes, Witness&) {
  nodes.front()->kill();
  nodes.front()->start();
}

/// The first of two nodes was killed; the service is at the second now, which is killed next.
void start_and_change_places(std::vector<NodeProcess*>& nodes, Witness& witness) {
  auto begin = Clock::now();
  nodes.front()->start();
  witness.await_up("at_" + nodes.front()->name(), begin);
  std::swap(nodes.front(), nodes.back());
}

std::vector<Case> cases() {
  const std::string here = "CPP UM service Service\n";
  const std::string on_one = "[one] CPP UM service Service";
  return {
    {"crash", 0ms, 1, "", here, {}, crash},
    {"crash, DELAY 50ms TO 50ms",
     50ms,
     5,
     "SUPERVISE a RESTARTS 1000000 IN 10min DELAY 50ms TO 50ms\n",
     here,
     {},
     crash},
    {"crash, on a node", 0ms, 1, "", on_one + "\n", {"one"}, crash},
    {"kill -9 of an isolated component",
     0ms,
     5,
     "",
     on_one + " --isolate\n",
     {"one"},
     kill_and_start_first},
    {"hang of an isolated component, --budget 200ms",
     200ms,
     10,
     "",
     on_one + " --isolate --budget 200ms\n",
     {"one"},
     hang},
    {"kill -9 of a node that is started again",
     0ms,
     5,
     "",
     on_one + "\n",
     {"one"},
     kill_and_start_first},
    {"kill -9 of a node, FAILOVER, patience 1 s",
     patience,
     50,
     "FAILOVER service TO [one] [two]\n",
     on_one + "\n[one] CPP UM at_one Bystander\n[two] CPP UM at_two Bystander\n",
     {"one", "two"},
     kill_first,
     start_and_change_places},
  };
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  castor::set_log_level(castor::LogLevel::off);
  if (is_node_process(argc, argv))
    return serve_as_node(argv);
  auto times = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1000;
  fmt::print("{:<44}{:>7}{:>9}{:>11}{:>11}{:>10}{:>10}{:>12}\n", "from the failure, ms", "times",
             "allowed", "noticed", "back: p50", "p99", "max", "over: p99");
  for (auto& x : cases())
    if (argc < 3 || std::string{x.name}.find(argv[2]) != std::string::npos)
      measure(x, times);
}
