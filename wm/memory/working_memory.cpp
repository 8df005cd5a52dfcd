#include "castor/wm/memory/working_memory.hpp"

#include "castor/wm/memory/working_memory_shell.hpp"

namespace castor {

WorkingMemoryActor::behavior_type
working_memory(WorkingMemoryActor::stateful_pointer<WorkingMemoryState> self,
               WorkingMemoryOptions options) {
  self->state.shell = std::make_shared<WorkingMemoryShell>(self, options);
  auto* shell = self->state.shell.get();
  self->set_down_handler([shell](const caf::down_msg& x) { shell->end(x.source); });
  return {
    [shell](const WriteRequest& x) {
      return shell->at_owner<Version>(x.address, x, [&] { return shell->write(x); });
    },
    [shell](const BatchRequest& x) {
      return shell->at_owner<std::vector<Version>>({x.subarchitecture, {}}, x,
                                                   [&] { return shell->write_all(x); });
    },
    [shell](const ReadRequest& x) {
      return shell->at_owner<EntryPtr>(x.address, x, [&] { return shell->read(x); });
    },
    [shell](const QueryRequest& x) {
      return shell->at_owner<std::vector<EntryPtr>>({x.query.subarchitecture, {}}, x,
                                                    [&] { return shell->query(x); });
    },
    [shell](const ExistsQuery& x) {
      return shell->at_owner<bool>(x.address, x, [&] { return shell->exists(x); });
    },
    [shell](const VersionQuery& x) {
      return shell->at_owner<Version>(x.address, x, [&] { return shell->version(x); });
    },
    [shell](const LockRequest& x) {
      return shell->at_owner<Lease>(x.address, x, [&] { return shell->lock(x); });
    },
    [shell](const UnlockRequest& x) {
      return shell->at_owner<Acknowledged>(x.address, x, [&] { return shell->unlock(x); });
    },
    [shell](const ClaimLease& x) { shell->claim(x); },
    [shell](const CancelWait& x) { shell->cancel(x); },
    [shell](const RenewRequest& x) { return shell->renew(x); },
    [shell](const LockQuery& x) {
      return shell->at_owner<LockStatus>(x.address, x, [&] { return shell->lock_status(x); });
    },
    [shell](const DeadlockProbe& x) { shell->follow(x); },
    [shell](WakeUp) { shell->wake_up(); },
    [shell](const JumpClock& x) { shell->jump_clock(x.by); },
    [shell](const JournalFault& x) { shell->outbox().inject_fault(x); },
    [shell](const Subscribe& x) { return shell->events().subscribe(x); },
    [shell](const Unsubscribe& x) { shell->events().unsubscribe(x); },
    [shell](const EventsTaken& x) { shell->events().acknowledge(x); },
    [shell](const Interest& x) { return shell->set_interest(x); },
    [shell](const ChangeNotices& x) { shell->events().receive(x); },
    [shell](const Peers& x) {
      shell->allow_writers(x.writers);
      return shell->events().introduce(x);
    },
    [shell](const JournalNews& x) { shell->outbox().receive(x); },
    [shell](StatusQuery) { return shell->status(); },
    [shell](UsageQuery) { return shell->usage(); },
  };
}

} // namespace castor
