#pragma once

#include "castor/tools/chaos/fault.hpp"
#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/chaos/seeded_random.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// What is drawn for a fault besides its kind and its target.
struct FaultDraws {
  SeededRandom& random;
  /// No fault lasts longer.
  Timestamp longest{0};
  /// How many callbacks its component will have, as far as that is known; at least 1.
  std::int64_t callbacks = 20;

  Timestamp duration();
  /// What a callback, a message or a write is late by.
  Timestamp lateness();
  Percent part();
};

/// A kind of fault that a system is to survive.
struct FaultKind {
  /// How often it is drawn, against the others that are possible in the system.
  std::size_t weight;
  /// One fault for each target in the system, with nothing but the target; none if it is
  /// impossible.
  std::vector<Fault> (*for_each_target)(const FaultTargets&);
  /// Draws what is missing.
  void (*complete)(Fault&, FaultDraws&);
  /// It takes effect in a callback of its component.
  bool needs_callback = false;
  /// It makes a component or a working memory fail, which counts against the restarts that its
  /// supervisor allows.
  bool costs_restart = false;
  /// It takes effect where its component is started again, which therefore has to crash.
  bool needs_crash = false;
};

/// All kinds of faults that a system is to survive.
std::span<const FaultKind> fault_kinds();

} // namespace castor::faults
