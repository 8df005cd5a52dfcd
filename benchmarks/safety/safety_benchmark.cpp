// How long a guarded robot drives on after a failure, until it brakes and until it stands, and how
// far it gets.
//
//   safety_benchmark [TIMES [CASE]]
//
// The robot drives a circle at 0.5 m/s, and brakes with 0.8 m/s^2. It and its laser are in this
// process, and its wheels do not slip; its guard, the driver, and the working memory with the
// driver's seat are in nodes of their own, processes of this program on 127.0.0.1. Each failure is
// injected TIMES (100) times.
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/system/fault_port.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"
#include "castor/benchmarks/node_process.hpp"
#include "castor/benchmarks/safety/braking_watch.hpp"
#include "castor/mapping/body/types.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <unistd.h>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;
using namespace mapping;
using Clock = BrakingWatch::Clock;

constexpr std::chrono::milliseconds patience = 10s;
constexpr std::chrono::milliseconds outage = 1s;
constexpr double speed = 0.5;
constexpr double braking = 0.8;
constexpr double bound = 300; // ms

BrakingWatch watch;

// -- the components

enum class LaserFault { none, silent, frozen };
std::atomic<LaserFault> laser_fault{LaserFault::none};

/// The laser, which may fail.
class FailingLaser final : public StandaloneComponent {
  void start() override {
    on_push<LaserScan>("robot", [this](auto& x) {
      auto scan = *x;
      const auto fault = laser_fault.load();
      if (fault == LaserFault::silent)
        return;
      if (fault == LaserFault::frozen)
        scan.ranges = last_;
      last_ = scan.ranges;
      push(std::move(scan));
    });
    on_push<BodyStatus>("robot", [](auto& x) { watch.add(*x); });
  }

  std::vector<float> last_;
};
CASTOR_COMPONENT(FailingLaser, "passes scans on")

/// After a restart it begins late, so that the robot stands before.
class CircleDriver final : public UnmanagedComponent {
  void run() override {
    sleep_for(outage);
    while (is_running()) {
      try {
        const auto seat = here("seat");
        if (!exists(seat))
          add(seat, DriverSeat{component_name()});
        const auto lease = lock(seat, LockLevel::o);
        while (sleep_for(50ms))
          stream_command("safety", DriveCommand{{speed, speed / 2}});
      } catch (const ConnectionError&) {
        // It has lost the lease, or the guard is out of reach: once more.
        sleep_for(10ms);
      } catch (const WorkingMemoryException&) {
        sleep_for(10ms);
      }
    }
  }
};
CASTOR_COMPONENT(CircleDriver, "drives circles of 2 m")

// -- the measurement

struct Nodes {
  System& system;
  std::map<std::string, NodeProcess>& processes;

  NodeProcess& at(const std::string& name) const { return processes.at(name); }
};

struct Case {
  const char* name;
  std::function<void(const Nodes&)> fail;
  std::function<void(const Nodes&)> mend = [](const Nodes&) {};
};

/// In the order of their numbers as processes; this one is 0.
const std::vector<std::string> node_names{"driving", "guarding", "keeping"};
constexpr ProcessNumber driving = 1;
constexpr ProcessNumber guarding = 2;

Case component_crash(const char* name, const std::string& component) {
  return {name,
          [component](const Nodes& x) { x.system.faults().inject(component, ComponentFault{}); }};
}

Case node_kill(const char* name, const std::vector<std::string>& nodes) {
  return {name,
          [nodes](const Nodes& x) {
            for (const auto& node : nodes)
              x.at(node).kill();
          },
          [nodes](const Nodes& x) {
            for (const auto& node : nodes)
              x.at(node).start();
          }};
}

Case node_stop(const char* name, const std::string& node) {
  return {name, [node](const Nodes& x) { x.at(node).signal(SIGSTOP); },
          [node](const Nodes& x) { x.at(node).signal(SIGCONT); }};
}

Case link_cut(const char* name, ProcessNumber a, ProcessNumber b) {
  return {name, [a, b](const Nodes& x) {
            x.system.faults().inject(a, b, LinkFault{LinkFault::Kind::silence, outage});
          }};
}

std::vector<Case> cases() {
  const auto repair_laser = [](const Nodes&) { laser_fault = LaserFault::none; };
  return {
    {"laser silent", [](const Nodes&) { laser_fault = LaserFault::silent; }, repair_laser},
    {"laser frozen", [](const Nodes&) { laser_fault = LaserFault::frozen; }, repair_laser},
    component_crash("driver crashes", "driver"),
    component_crash("working memory crashes", "navigation_wm"),
    {"guard hangs for 1 s",
     [](const Nodes& x) {
       x.system.faults().inject("safety", ComponentFault{ComponentFault::Kind::hang, 1, outage});
     }},
    node_kill("kill -9 of driver's node", {"driving"}),
    node_kill("kill -9 of memory's node", {"keeping"}),
    node_kill("kill -9 of guard's node", {"guarding"}),
    node_kill("kill -9 of all nodes", node_names),
    node_stop("SIGSTOP of driver's node", "driving"),
    node_stop("SIGSTOP of memory's node", "keeping"),
    node_stop("SIGSTOP of guard's node", "guarding"),
    link_cut("link cut: driver, guard", driving, guarding),
    link_cut("link cut: guard, robot", guarding, 0),
  };
}

std::string architecture(const std::filesystem::path& folder) {
  std::string hosts;
  for (const auto& name : node_names)
    hosts += "HOSTNAME " + name + ' ' + name + '\n';
  return hosts +
         "SUPERVISE * RESTARTS 1000000 IN 1s DELAY 0ms TO 0ms\n"
         "COMPONENT CPP robot SimulatedRobot --building hall.building --base " +
         folder.string() +
         " --commander safety --odometry-period 10ms --slip 0 --diameter-error 0\n"
         "COMPONENT CPP laser FailingLaser\n"
         "COMPONENT [guarding] CPP safety SafetyGuard --laser laser --lease navigation/seat\n"
         "SUBARCHITECTURE navigation [keeping]\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "[driving] CPP UM driver CircleDriver\n";
}

void measure(const Case& x, int times, const std::filesystem::path& folder) {
  std::map<std::string, NodeProcess> processes;
  SystemOptions options;
  options.link = link_options(patience);
  for (const auto& name : node_names)
    options.nodes[name] = processes.try_emplace(name, name, patience).first->second.endpoint();
  auto parsed = cast::parse_string(architecture(folder), "benchmark");
  std::vector<double> braked;
  std::vector<double> stood;
  std::vector<double> ways;
  int late = 0;
  {
    System system{parsed.architecture.value(), options};
    system.start();
    const Nodes nodes{system, processes};
    for (int i = 0; i < times; ++i) {
      const auto at = watch.await_cruise(speed);
      const auto begin = Clock::now();
      x.fail(nodes);
      const auto stop = watch.await_stop(begin, at, braking);
      braked.push_back(milliseconds(stop.braked));
      stood.push_back(milliseconds(stop.stood));
      ways.push_back(stop.way);
      late += braked.back() > bound ? 1 : 0;
      x.mend(nodes);
    }
    system.stop();
  }
  fmt::print("{:<28}{:>6}{:>9.0f}{:>7.0f}{:>7.0f}{:>8.0f}{:>7.0f}{:>8.3f}{:>8.3f}{:>7}{:>12}\n",
             x.name, braked.size(), percentile(braked, 50), percentile(braked, 99),
             percentile(braked, 100), percentile(stood, 50), percentile(stood, 100),
             percentile(ways, 50), percentile(ways, 100), late, watch.collisions());
  std::fflush(stdout);
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  castor::set_log_level(castor::LogLevel::off);
  if (is_node_process(argc, argv))
    return serve_as_node(argv);
  const auto times = argc > 1 ? std::max(1, std::atoi(argv[1])) : 100;
  const auto folder =
    std::filesystem::temp_directory_path() / ("safety_benchmark-" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  std::ofstream{folder / "hall.building"} << "wall 0 0 to 20 0 to 20 20 to 0 20 close\n"
                                             "start 10 8\n";
  fmt::print("{:<28}{:>6}{:>9}{:>7}{:>7}{:>8}{:>7}{:>8}{:>8}{:>7}{:>12}\n", "ms, m", "times",
             "brakes:50", "p99", "max", "stands", "max", "way", "max", ">300", "collisions");
  for (const auto& x : cases())
    if (argc < 3 || std::string{x.name}.find(argv[2]) != std::string::npos)
      measure(x, times, folder);
  std::filesystem::remove_all(folder);
}
