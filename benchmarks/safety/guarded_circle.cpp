#include "castor/benchmarks/safety/guarded_circle.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/body/types.hpp"

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <fstream>
#include <utility>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;
using namespace mapping;

std::atomic<LaserFault> laser_fault{LaserFault::none};

void take_laser_signal(int signal) {
  laser_fault = static_cast<LaserFault>(signal - SIGRTMIN);
}

/// The robot's laser, which may fail.
class FailingLaser final : public StandaloneComponent {
  void start() override {
    on_push<LaserScan>("robot", [this](auto& x) {
      const auto fault = laser_fault.load();
      if (fault == LaserFault::silent)
        return;
      auto scan = *x;
      if (fault == LaserFault::frozen)
        scan.ranges = last_;
      if (fault == LaserFault::obstacle)
        put_obstacle_before(scan);
      last_ = scan.ranges;
      push(std::move(scan));
    });
  }

  /// Something flat, a centimetre before the edge of the robot, as wide as a person.
  static void put_obstacle_before(LaserScan& x) {
    constexpr double radius = 0.25;
    constexpr double before = 0.01;
    constexpr double half_width = 0.2;
    const double distance = radius + before - x.mount.x;
    for (std::size_t i = 0; i < x.ranges.size(); ++i) {
      const double angle = x.first_angle + static_cast<double>(i) * x.angle_step;
      if (std::abs(angle) < std::atan2(half_width, distance))
        x.ranges[i] = static_cast<float>(distance / std::cos(angle));
    }
  }

  std::vector<float> last_;
};
CASTOR_COMPONENT(FailingLaser, "passes scans on")

class StatusWatcher final : public StandaloneComponent {
  void start() override {
    on_push<BodyStatus>("robot", [](auto& x) { circle_watch().add(*x); });
  }
};
CASTOR_COMPONENT(StatusWatcher, "sees what the robot does")

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
          stream_command("safety", DriveCommand{{circle_speed, circle_speed / 2}});
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

} // namespace

const std::vector<std::string>& circle_nodes() {
  static const std::vector<std::string> names{"base", "driving", "guarding", "keeping", "sensing"};
  return names;
}

std::string guarded_circle(const std::filesystem::path& folder) {
  std::ofstream{folder / "hall.building"} << "wall 0 0 to 20 0 to 20 20 to 0 20 close\n"
                                             "start 10 8\n";
  std::string hosts;
  for (const auto& name : circle_nodes())
    hosts += "HOSTNAME " + name + ' ' + name + '\n';
  // Wheels that do not slip, so that the robot's speed is its wheels'.
  return hosts +
         "SUPERVISE * RESTARTS 1000000 IN 1s DELAY 0ms TO 0ms\n"
         "COMPONENT [base] CPP robot SimulatedRobot --building hall.building --base " +
         folder.string() +
         " --commander safety --valid-for 200ms --odometry-period 10ms --slip 0 --diameter-error "
         "0\n"
         "COMPONENT CPP watcher StatusWatcher\n"
         "COMPONENT [sensing] CPP laser FailingLaser\n"
         "COMPONENT [guarding] CPP safety SafetyGuard --laser laser --lease navigation/seat\n"
         "SUBARCHITECTURE navigation [keeping]\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "[driving] CPP UM driver CircleDriver\n";
}

BrakingWatch& circle_watch() {
  static BrakingWatch watch;
  return watch;
}

int signal_of(LaserFault x) {
  return SIGRTMIN + static_cast<int>(x);
}

void obey_laser_signals() {
  for (const auto x :
       {LaserFault::none, LaserFault::silent, LaserFault::frozen, LaserFault::obstacle})
    std::signal(signal_of(x), take_laser_signal);
}

} // namespace castor::benchmark
