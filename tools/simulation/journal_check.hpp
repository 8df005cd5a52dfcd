#pragma once

#include "castor/tools/simulation/simulated_machines.hpp"

#include <cstdint>

namespace castor::simulation {

/// Changes that somebody was told of, of working memories with journals.
struct JournalCounts {
  std::uint64_t found = 0;
  /// Not in the journal, as may be.
  std::uint64_t lost = 0;
  /// Of the lost ones, those after which another would have been one too many.
  std::uint64_t lost_at_bound = 0;
};

/// Nobody was told of a change that is not in the journal, but for those that `batched` may lose:
/// any other is a finding.
JournalCounts check_journals(SystemWorld& world, const SimulatedMachines& machines);

} // namespace castor::simulation
