#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/tools/chaos/activity.hpp"
#include "castor/tools/chaos/chaos_run.hpp"
#include "castor/tools/chaos/fault_plan.hpp"
#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/cli/final_state.hpp"
#include "castor/tools/cli/read_workload.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// One trial of `castor chaos`: starts a system, runs it with or without faults, and checks the
/// results.
namespace castor::cli {

class Progress;
class Signals;

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
  std::uint64_t workload_seed(std::uint64_t seed) const;
};

/// Results of a run without faults.
struct FaultlessRun {
  /// Seed that the actions of the workload were drawn from.
  std::uint64_t workload_seed = 0;
  /// Activity of components.
  std::optional<faults::ActivityByComponent> activity;
  /// State after the system has settled, from `state_of`.
  std::vector<std::string> state;
  /// Violations in the run without faults.
  std::vector<faults::Violation> violations;
};

/// @param seed for the actions of the workload
FaultlessRun run_without_faults(const ChaosSetup& setup, std::uint64_t seed, const Signals& signals,
                                Progress& progress);

/// Adds events and findings to `run`, in which the run is already described.
/// @param wanted the expected final state, from a run without faults
/// @param report is called when all results are known, before the system is destroyed: a component
///   may block its destruction, and then the process ends
void run_with_faults(const ChaosSetup& setup, const faults::FaultPlan& plan,
                     const std::vector<std::string>& wanted, const Signals& signals,
                     Progress& progress, faults::ChaosRun& run,
                     const std::function<void()>& report);

} // namespace castor::cli
