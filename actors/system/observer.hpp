#pragma once

#include "castor/actors/node/system_options.hpp"
#include "castor/base/caf.hpp"
#include "castor/base/log.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_response_promise.hpp>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace castor {

/// To an observer: the working memories that there are now, and the level at which changes in some
/// of them are logged.
struct ObservedSystem {
  std::map<std::string, WorkingMemoryActor> working_memories;
  std::map<std::string, LogLevel> logged;
};

/// To an observer: answered with true once it has reported all that it was sent before.
struct FlushObserver {};

/// A change whose entry is being read.
struct AwaitedEntry {
  /// Sequence number of the change.
  std::uint64_t number = 0;
  ChangeEventPtr event;
  EntryPtr entry;
  bool is_read = false;
};

struct AwaitedFlush {
  /// Number of the last change that is to be reported before.
  std::uint64_t number = 0;
  caf::typed_response_promise<bool> promise;
};

struct ObserverState {
  static constexpr const char* name = "observer";

  ObservedSystem system;
  std::map<std::string, Receipts> receipts;
  /// By subarchitecture, in the order in which they are to be reported.
  std::map<std::string, std::deque<std::shared_ptr<AwaitedEntry>>> awaited;
  std::uint64_t last_awaited = 0;
  std::vector<AwaitedFlush> flushes;
};

/// Calls `SystemOptions::on_change`, `on_entry`, `on_watched` and `on_task`, one at a time, and
/// logs changes. It has to be sent ObservedSystem when something is added or removed. The options
/// have to outlive it.
caf::behavior observer(caf::stateful_actor<ObserverState>* self, const SystemOptions& options);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::ObservedSystem)
CASTOR_LOCAL_MESSAGE(castor::FlushObserver)
