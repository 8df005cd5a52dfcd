#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/processes.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/system/observation.hpp"
#include "castor/actors/system/roster_feed.hpp"
#include "castor/actors/system/supervisor_client.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace castor {

/// Adds components to a running system, and removes them.
class Reconfiguration {
public:
  /// All of them have to outlive it. The architecture is that of the system, and follows its
  /// changes.
  Reconfiguration(ArchitectureDescription& architecture, const SystemOptions& options,
                  Processes& processes, const RosterFeed& roster, SupervisorClient& supervisor,
                  Observation& observation);

  /// Returns the problems; if there are any, the system is unchanged.
  std::vector<Diagnostic> add(ArchitectureDescription added);

  /// Returns the error; empty on success.
  std::string remove(const std::string& name);

private:
  void revert(Placement placement);
  void forget_lost_hosts(Placement& placement) const;

  ArchitectureDescription& architecture_;
  const SystemOptions& options_;
  Processes& processes_;
  const RosterFeed& roster_;
  SupervisorClient& supervisor_;
  Observation& observation_;
  /// Number of the next component that is added.
  std::size_t next_number_ = 0;
};

} // namespace castor
