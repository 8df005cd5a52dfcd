#pragma once

#include "castor/actors/component/log.hpp"
#include "castor/actors/node/system.hpp"
#include "castor/wm/caf.hpp"

#include <caf/stateful_actor.hpp>

#include <map>
#include <set>
#include <string>

namespace castor {

/// To an observer: the working memories that there are now, and the level at which changes in some
/// of them are logged.
struct ObservedSystem {
  std::map<std::string, WorkingMemoryActor> working_memories;
  std::map<std::string, LogLevel> logged;
};

/// To an observer, which answers with true: has it told all that it was sent before?
struct FlushObserver {};

struct ObserverState {
  static constexpr const char* name = "observer";

  ObservedSystem system;
  std::map<std::string, Receipts> receipts;
};

/// Calls `SystemOptions::on_change`, `on_watched` and `on_task`, one at a time, and logs changes.
/// It has to be sent ObservedSystem when something is added or removed. The options have to outlive
/// it.
caf::behavior observer(caf::stateful_actor<ObserverState>* self, const SystemOptions& options);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::ObservedSystem)
CASTOR_LOCAL_MESSAGE(castor::FlushObserver)
