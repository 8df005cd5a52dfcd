#pragma once

#include "castor/tools/chaos/fault_plan.hpp"
#include "castor/tools/chaos/fault_targets.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace castor::faults {

/// What components have done in a run without faults: callbacks and operations per second.
struct ComponentActivity {
  double callbacks = 0;
  double operations = 0;
};
using ActivityByComponent = std::map<std::string, ComponentActivity>;

/// How much a plan that nobody has written asks of a system.
struct RandomPlanOptions {
  /// Between the beginnings of two faults, on average.
  Timestamp interval = std::chrono::seconds{2};
  /// No fault lasts longer.
  Timestamp longest = std::chrono::seconds{3};
  /// At the end nothing fails, so that the system can recover; in short runs, for a quarter of the
  /// duration.
  Timestamp rest = std::chrono::seconds{10};
  /// No supervisor is asked for more restarts than it allows: what would be too much is left out.
  bool within_restart_limits = true;
  /// Only faults that make a component or a working memory fail.
  bool failures_only = false;
  /// Faults go to components the more often, the more these do, and no fault waits for a callback
  /// that will hardly come. Nothing: all components are alike.
  std::optional<ActivityByComponent> activity;
};

/// A mix of all that a system of that kind is to survive (`fault_kinds`), so no end of a working
/// memory without a journal, and no fault without an end. The plan names times and targets; it
/// follows from the seed and what components do, and is the same on every machine.
FaultPlan random_plan(const FaultTargets& targets, std::uint64_t seed, Timestamp duration,
                      const RandomPlanOptions& options = {});

} // namespace castor::faults
