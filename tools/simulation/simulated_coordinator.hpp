#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/component/health.hpp"
#include "castor/actors/node/processes.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/base/caf.hpp"
#include "castor/tools/simulation/simulated_machines.hpp"

#include <functional>
#include <optional>
#include <string>

namespace castor::simulation {

/// The coordinator of a simulated system, with the product's supervisor and part agent.
class SimulatedCoordinator {
public:
  /// Callbacks for components that go down and come up, called on the simulation's thread.
  struct Reports {
    std::function<void(const ComponentDown&)> on_down;
    std::function<void(const ComponentUp&)> on_up;
  };

  SimulatedCoordinator(caf::actor_system& system, SystemWorld& world, SimulatedMachines& machines)
    : system_(system), world_(world), machines_(machines) {}
  SimulatedCoordinator(const SimulatedCoordinator&) = delete;
  SimulatedCoordinator& operator=(const SimulatedCoordinator&) = delete;

  /// Deploys an architecture on all machines, and starts its components. `epoch` is the time at
  /// which the system began.
  void start(const ArchitectureDescription& architecture, Reports reports,
             caf::actor_clock::time_point epoch);

  bool has_started() const { return started_; }
  /// Reason of the system's end; nothing while it runs.
  const std::optional<std::string>& ended() const { return ended_; }

  /// Tells its actors to end, which they do when they are run.
  void end();
  /// To be called after `end`: closes the mesh, so that its actors cannot be addressed any more.
  void close();

private:
  void spawn_supervisor(caf::actor_clock::time_point epoch);
  void spawn_agent();
  void deploy(const ArchitectureDescription& architecture, const Placement& placement);

  caf::actor_system& system_;
  SystemWorld& world_;
  SimulatedMachines& machines_;
  SystemOptions options_;
  std::optional<Processes> processes_;
  caf::actor end_listener_;
  caf::actor supervisor_;
  caf::actor agent_;
  caf::actor phase_controller_;
  bool started_ = false;
  std::optional<std::string> ended_;
};

} // namespace castor::simulation
