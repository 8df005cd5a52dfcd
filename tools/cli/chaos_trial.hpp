#pragma once

#include "castor/tools/chaos/activity.hpp"
#include "castor/tools/chaos/chaos_run.hpp"
#include "castor/tools/chaos/fault_plan.hpp"
#include "castor/tools/cli/chaos_setup.hpp"

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
