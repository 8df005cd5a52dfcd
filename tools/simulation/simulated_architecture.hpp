#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/wm/journal/journal.hpp"

#include <chrono>
#include <cstddef>

namespace castor::simulation {

/// Parameters of simulated architectures.
struct ArchitectureVariant {
  std::chrono::milliseconds lease{300};
  /// Supervision strategy, 0 to 2.
  std::size_t strategy = 0;
  /// Whether a few restarts already escalate to the whole subarchitecture.
  bool escalates = false;
  /// Whether some components fail over when their node is lost.
  bool moves = false;
  /// One to three.
  std::size_t machines = 3;
  /// Journal mode of the working memories.
  JournalMode journals = JournalMode::off;

  auto operator<=>(const ArchitectureVariant&) const = default;
};

/// Three subarchitectures, `a`, `b` and `c`, each with a task manager and two components.
const ArchitectureDescription& simulated_architecture(const ArchitectureVariant& variant);

} // namespace castor::simulation
