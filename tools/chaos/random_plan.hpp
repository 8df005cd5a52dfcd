#pragma once

#include "castor/tools/chaos/fault_plan.hpp"
#include "castor/tools/chaos/fault_targets.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace castor::faults {

/// Activity of a component in a run without faults: callbacks and operations per second.
struct ComponentActivity {
  double callbacks = 0;
  double operations = 0;
};
using ActivityByComponent = std::map<std::string, ComponentActivity>;

/// Options of randomly generated plans.
struct RandomPlanOptions {
  /// Average time between the beginnings of two faults.
  Timestamp interval = std::chrono::seconds{2};
  /// Longest duration of a fault.
  Timestamp longest = std::chrono::seconds{3};
  /// Time without faults at the end, so that the system can recover; at most a quarter of the
  /// duration.
  Timestamp rest = std::chrono::seconds{10};
  /// Leaves out faults that would exceed a supervisor's restart limit.
  bool within_restart_limits = true;
  /// Only faults that make a component or a working memory fail.
  bool failures_only = false;
  /// Chooses components in proportion to their activity, and no callbacks that are unlikely to
  /// come. Nothing: all components are equally likely.
  std::optional<ActivityByComponent> activity;
};

/// A random mix of all faults that a system has to survive (`fault_kinds`): working memories
/// without a journal do not end, and no fault is without end. Times and targets are fixed. The plan
/// is determined by the seed and the activity of components, and is the same on every machine.
FaultPlan random_plan(const FaultTargets& targets, std::uint64_t seed, Timestamp duration,
                      const RandomPlanOptions& options = {});

} // namespace castor::faults
