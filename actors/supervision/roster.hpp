#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/runtime/status.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// Participants of a system, for observers.
struct SystemRoster {
  std::string file;
  std::chrono::steady_clock::time_point epoch;
  /// By their numbers, with the agent of each.
  std::vector<ProcessDescription> processes;
  std::vector<caf::actor> agents;
  std::map<std::string, WorkingMemoryActor> working_memories;
  /// Stand-alone components.
  std::map<std::string, caf::actor> providers;
  /// Of all components, working memories included.
  std::map<std::string, ProcessNumber> placement;
  /// In the order of their start, without working memories; only identities and restart counts are
  /// set.
  std::vector<ComponentStatus> components;
  /// Placement of the hosts of the file.
  Placement hosts;
};

using SystemRosterPtr = std::shared_ptr<const SystemRoster>;

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::SystemRosterPtr)
