#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/cli/final_state.hpp"
#include "castor/tools/cli/read_workload.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace castor::cli {

/// Settings common to all trials of a command.
struct ChaosSetup {
  std::vector<std::string> plugins;
  ArchitectureDescription architecture;
  faults::FaultTargets targets;
  std::optional<CheckedWorkload> workload;
  /// Entries whose final state must be the same as without faults.
  ComparedEntries compared;
  std::chrono::milliseconds duration{0};
  /// The system has settled when nothing has changed for this long.
  std::chrono::milliseconds settle{0};
  /// Longest time after going down within which a target must be back or given up.
  std::chrono::milliseconds bound{0};

  /// Seed for the actions of the workload in a trial with this seed; 0 without a workload.
  std::uint64_t workload_seed(std::uint64_t seed) const {
    return workload ? workload->workload.seed.value_or(seed) : 0;
  }
};

} // namespace castor::cli
