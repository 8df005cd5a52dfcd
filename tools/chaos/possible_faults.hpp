#pragma once

#include "castor/tools/chaos/fault.hpp"
#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/chaos/seeded_random.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// Random parameters of a fault, other than its kind and its target.
struct FaultDraws {
  SeededRandom& random;
  /// Longest duration of a fault.
  Timestamp longest{0};
  /// Expected number of callbacks of its component; at least 1.
  std::int64_t callbacks = 20;

  Timestamp duration();
  /// Delay of a callback, a message or a write.
  Timestamp lateness();
  Percent part();
};

/// A kind of fault that a system has to survive.
struct FaultKind {
  /// Relative frequency among the kinds that are possible in the system.
  std::size_t weight;
  /// One fault for each target in the system, without its parameters; empty if the kind is
  /// impossible.
  std::vector<Fault> (*for_each_target)(const FaultTargets&);
  /// Draws the parameters.
  void (*complete)(Fault&, FaultDraws&);
  /// Takes effect in a callback of its component.
  bool needs_callback = false;
  /// Makes a component or a working memory fail, which counts against its supervisor's restart
  /// limit.
  bool costs_restart = false;
  /// Takes effect when its component is restarted, so it has to be combined with a crash.
  bool needs_crash = false;
};

/// All kinds of faults that a system has to survive.
std::span<const FaultKind> fault_kinds();

} // namespace castor::faults
