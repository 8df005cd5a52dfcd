#include "castor/benchmarks/safety/failure_kinds.hpp"

#include "castor/actors/system/fault_port.hpp"
#include "castor/benchmarks/safety/guarded_circle.hpp"

#include <csignal>
#include <thread>
#include <utility>

namespace castor::benchmark {

namespace {

FailureKind laser_failure(std::string name, LaserFault fault) {
  const auto signal = [](LaserFault y) {
    return [y](const CircleSystem& x) { x.processes.at("sensing").signal(signal_of(y)); };
  };
  return {std::move(name), signal(fault), signal(LaserFault::none)};
}

FailureKind component_failure(std::string name, std::string component,
                              const ComponentFault& fault) {
  return {std::move(name), [component = std::move(component), fault](const CircleSystem& x) {
            x.system.faults().inject(component, fault);
          }};
}

FailureKind node_kill(std::string name, std::vector<std::string> nodes) {
  return {std::move(name),
          [nodes](const CircleSystem& x) {
            for (const auto& node : nodes)
              x.processes.at(node).kill();
          },
          [nodes](const CircleSystem& x) {
            for (const auto& node : nodes)
              x.processes.at(node).start();
          }};
}

FailureKind node_stop(std::string name, std::string node) {
  return {std::move(name), [node](const CircleSystem& x) { x.processes.at(node).signal(SIGSTOP); },
          [node](const CircleSystem& x) { x.processes.at(node).signal(SIGCONT); }};
}

/// What the robot did meanwhile is known once its process goes on.
FailureKind base_stop(std::string name) {
  return {std::move(name), [](const CircleSystem& x) {
            x.processes.at("base").signal(SIGSTOP);
            std::this_thread::sleep_for(outage);
            x.processes.at("base").signal(SIGCONT);
          }};
}

FailureKind link_cut(const std::string& a, const std::string& b) {
  return {"link cut: " + a + ", " + b, [a, b](const CircleSystem& x) {
            x.system.faults().inject(x.numbers.at(a), x.numbers.at(b),
                                     LinkFault{LinkFault::Kind::silence, outage});
          }};
}

} // namespace

std::vector<FailureKind> failure_kinds() {
  return {
    laser_failure("laser silent", LaserFault::silent),
    laser_failure("laser frozen", LaserFault::frozen),
    laser_failure("obstacle within stopping distance", LaserFault::obstacle),
    component_failure("driver crashes", "driver", {}),
    component_failure("working memory crashes", "navigation_wm", {}),
    component_failure("guard hangs for 1 s", "safety", {ComponentFault::Kind::hang, 1, outage}),
    node_kill("kill -9: driving", {"driving"}),
    node_kill("kill -9: keeping", {"keeping"}),
    node_kill("kill -9: guarding", {"guarding"}),
    node_kill("kill -9: sensing", {"sensing"}),
    node_kill("kill -9: all but base", {"driving", "guarding", "keeping", "sensing"}),
    node_stop("SIGSTOP: driving", "driving"),
    node_stop("SIGSTOP: keeping", "keeping"),
    node_stop("SIGSTOP: guarding", "guarding"),
    node_stop("SIGSTOP: sensing", "sensing"),
    base_stop("SIGSTOP: base"),
    link_cut("driving", "guarding"),
    link_cut("guarding", "keeping"),
    link_cut("base", "guarding"),
    link_cut("base", "sensing"),
    link_cut("guarding", "sensing"),
  };
}

} // namespace castor::benchmark
