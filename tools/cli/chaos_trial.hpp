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

/// What `castor chaos` does once or for many seeds: to start a system, to let it run under faults
/// or without, and to look into what it did.
namespace castor::cli {

class Progress;
class Signals;

/// What all trials of a command have in common.
struct ChaosSetup {
  std::vector<std::string> plugins;
  ArchitectureDescription architecture;
  faults::FaultTargets targets;
  std::optional<CheckedWorkload> workload;
  /// Which entries have to be in the end as they are without faults.
  StateQuestion question;
  std::chrono::milliseconds duration{0};
  /// The system has come to rest when nothing has changed for so long.
  std::chrono::milliseconds settle{0};
  /// Within which whatever goes down has to be back, or given up.
  std::chrono::milliseconds bound{0};

  /// What draws the actions of the workload, in a trial with this seed; 0 without a workload.
  std::uint64_t workload_seed(std::uint64_t seed) const;
};

/// What a system does without faults.
struct FaultlessRun {
  /// The actions of the workload were drawn from it.
  std::uint64_t workload_seed = 0;
  /// What components did.
  std::optional<faults::ActivityByComponent> activity;
  /// As `state_of` gives it, at rest.
  std::vector<std::string> state;
  /// What does not hold even then.
  std::vector<faults::Violation> violations;
};

/// The workload's actions are drawn from the seed.
FaultlessRun run_without_faults(const ChaosSetup& setup, std::uint64_t seed, const Signals& signals,
                                Progress& progress);

/// Adds what happened and what was found to `run`, which says already which run it is.
/// @param wanted the entries that count, as they are without faults
/// @param report is called when all is known and before the system is destroyed, which a component
///   can block: then the process ends
void run_with_faults(const ChaosSetup& setup, const faults::FaultPlan& plan,
                     const std::vector<std::string>& wanted, const Signals& signals,
                     Progress& progress, faults::ChaosRun& run,
                     const std::function<void()>& report);

} // namespace castor::cli
