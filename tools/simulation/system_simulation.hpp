#pragma once

#include "castor/tools/chaos/fault_plan.hpp"
#include "castor/tools/simulation/happenings.hpp"
#include "castor/tools/simulation/memory_simulation.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace castor::simulation {

struct SystemResult : linearizability::SimulationResult {
  std::uint64_t seed = 0;
  /// What was injected.
  faults::FaultPlan faults;
  /// Stands for all that happened: that of the same seed and faults is the same.
  std::uint64_t digest = 0;
  /// How many messages were worked off, or how often time passed.
  std::size_t steps = 0;
  /// How often something went down.
  std::size_t failures = 0;
  /// How often something came back.
  std::size_t returns = 0;
  /// How often a working memory lost what it held.
  std::size_t losses = 0;
  /// Operations of clients.
  std::size_t operations = 0;
  Happenings happened;
};

/// A whole system on CAF's test coordinator: a coordinator and two nodes, three subarchitectures
/// with two components each, with the supervisor, agents, working memories, meshes, link ends and
/// wire format of the product, over simulated connections. Who runs next, when time passes, what
/// the components do and what fails follows from a seed.
///
/// When all faults are over the system has to be whole again within some time. What its components
/// saw is checked then, and that nothing is left of those who died.
class SystemSimulation {
public:
  SystemSimulation();
  ~SystemSimulation();

  /// One run, checked. With the faults of the seed, or with these.
  SystemResult run(std::uint64_t seed, const std::optional<faults::FaultPlan>& faults = {});

private:
  class Stage;
  std::unique_ptr<Stage> stage_;
};

/// As few of the faults of a seed that violates something as it takes.
faults::FaultPlan minimised(SystemSimulation& simulation, std::uint64_t seed,
                            const faults::FaultPlan& faults);

} // namespace castor::simulation
