#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/wm/journal/journal.hpp"

#include <chrono>
#include <cstddef>

namespace castor::simulation {

/// What differs between simulated architectures.
struct ArchitectureVariant {
  std::chrono::milliseconds lease{300};
  /// One of the three supervision strategies that there are.
  std::size_t strategy = 0;
  /// Whether a few restarts already take the whole subarchitecture along.
  bool escalates = false;
  /// Whether some components may run elsewhere when their node is lost.
  bool moves = false;
  /// One to three.
  std::size_t machines = 3;
  /// Of the working memories.
  JournalMode journals = JournalMode::off;

  auto operator<=>(const ArchitectureVariant&) const = default;
};

/// Three subarchitectures, `a`, `b` and `c`, each with a task manager and two components.
const ArchitectureDescription& simulated_architecture(const ArchitectureVariant& variant);

} // namespace castor::simulation
