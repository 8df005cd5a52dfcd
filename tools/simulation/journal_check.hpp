#pragma once

#include "castor/tools/simulation/simulated_machines.hpp"

#include <cstdint>

namespace castor::simulation {

/// Counts of changes that components received events of, on working memories with journals.
struct JournalCounts {
  std::uint64_t found = 0;
  /// Not in the journal, within the bounds of its mode.
  std::uint64_t lost = 0;
  /// Changes lost when the bound on lost changes was reached exactly.
  std::uint64_t lost_at_bound = 0;
};

/// Checks that every change of which a component received an event is in the journal, except for
/// those that `batched` may lose. Violations are added to the world's findings.
JournalCounts check_journals(SystemWorld& world, const SimulatedMachines& machines);

} // namespace castor::simulation
