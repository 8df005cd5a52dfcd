#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/processes.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/system/component_statuses.hpp"
#include "castor/actors/system/roster_feed.hpp"
#include "castor/actors/system/system_summary.hpp"

#include <caf/scoped_actor.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace castor {

/// Requests the status of the processes and working memories of a system, and waits for their
/// answers. Those that are out of reach, or do not answer in time, are left out.
class StatusCollector {
public:
  /// All of them have to outlive it.
  StatusCollector(caf::actor_system& system, const SystemOptions& options,
                  const ArchitectureDescription& architecture, const Processes& processes,
                  const RosterFeed& roster)
    : self_(system), options_(options), architecture_(architecture), processes_(processes),
      roster_(roster) {}

  /// In the order of the file.
  std::vector<WorkingMemoryStatus> working_memories();
  std::uint64_t sum_of(std::uint64_t WorkingMemoryStatus::*counter);
  std::vector<ComponentStatus> components();
  /// Whether all components have ended and none will be started again, as far as the supervisor
  /// knows, which costs nobody anything.
  bool is_nobody_left() const;
  /// `stuck` are the components that did not stop.
  SystemSummary summary(const std::vector<std::string>& stuck);
  /// Everything in a subarchitecture's working memory, the most recently written first.
  std::vector<EntryPtr> entries(const std::string& subarchitecture);

private:
  PartStatuses parts();

  caf::scoped_actor self_;
  const SystemOptions& options_;
  const ArchitectureDescription& architecture_;
  const Processes& processes_;
  const RosterFeed& roster_;
};

} // namespace castor
