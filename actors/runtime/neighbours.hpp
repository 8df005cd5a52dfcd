#pragma once

#include "castor/base/caf.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// The other actors of a system that a component uses, in any process; immutable.
struct Neighbours {
  /// By subarchitecture.
  std::map<std::string, WorkingMemoryActor> working_memories;
  std::map<std::string, caf::actor> task_managers;
  /// Stand-alone components, by name.
  std::map<std::string, caf::actor> providers;
  /// Names of all stand-alone components of the system, of which some may be down; and whether they
  /// are started again if they fail.
  std::map<std::string, bool> known_providers;
};

using NeighboursPtr = std::shared_ptr<const Neighbours>;

/// The subarchitectures whose working memory is gone since `before`; another may have taken its
/// place.
std::vector<std::string> lost_working_memories(const Neighbours& before, const Neighbours& now);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::NeighboursPtr)
