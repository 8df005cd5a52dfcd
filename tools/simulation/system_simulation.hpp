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
  /// The injected faults.
  faults::FaultPlan faults;
  /// Digest of all that happened; equal for equal seeds and faults.
  std::uint64_t digest = 0;
  /// Number of steps: messages handled, or times that time passed.
  std::size_t steps = 0;
  /// Number of times that a target went down.
  std::size_t failures = 0;
  /// Number of times that a target came back.
  std::size_t returns = 0;
  /// Number of times that a working memory lost its entries.
  std::size_t losses = 0;
  /// Number of clients' operations.
  std::size_t operations = 0;
  Happenings happened;
};

/// A whole system on CAF's test coordinator: a coordinator and two nodes, three subarchitectures
/// with two components each, with the supervisor, agents, working memories, meshes, link ends and
/// wire format of the product, over simulated connections. A seed determines which actor runs next,
/// when time passes, what the components do, and the faults.
///
/// After the last fault, everything must be up again within a time limit. Then the components'
/// operations and events are checked, and that nothing is left of ended components.
class SystemSimulation {
public:
  SystemSimulation();
  ~SystemSimulation();

  /// Simulates and checks one run, with the faults of the seed or with these.
  SystemResult run(std::uint64_t seed, const std::optional<faults::FaultPlan>& faults = {});

private:
  class Stage;
  std::unique_ptr<Stage> stage_;
};

/// A minimal set of the faults of a seed that still causes a violation.
faults::FaultPlan minimised(SystemSimulation& simulation, std::uint64_t seed,
                            const faults::FaultPlan& faults);

} // namespace castor::simulation
