#pragma once

#include "castor/wm/working_memory.hpp"

#include <memory>
#include <vector>

/// What the working memory actor is put together from; of no use outside.
namespace castor::working_memory_parts {

using Self = WorkingMemoryActor::stateful_pointer<WorkingMemoryState>;

/// Time since the system began.
Timestamp now(Self self);

/// Null if there is no such subarchitecture, or if it is the own one.
const WorkingMemoryActor* find_peer(const WorkingMemoryState& state, const std::string& name);

Failure unknown_subarchitecture(const WorkingMemoryState& state, const Address& address);

/// Answers here what is ours, hands on what is another working memory's.
template <class Reply, class Request, class F>
caf::result<Outcome<Reply>> at_owner(Self self, const Address& address, const Request& request,
                                     F&& answer) {
  auto& state = self->state;
  if (address.subarchitecture == state.options.subarchitecture)
    return answer();
  if (auto* peer = find_peer(state, address.subarchitecture))
    return self->delegate(*peer, request);
  return Outcome<Reply>{unknown_subarchitecture(state, address)};
}

/// Learns of the end of an actor; once is enough.
void monitor(Self self, const caf::strong_actor_ptr& who);

// -- changes

/// Applies effects that were prepared together, and tells everybody who wants to know.
void commit(Self self, std::vector<EntryStore::Effect> effects);

// -- leases

/// Ends what is over by now: leases, waits, entries. Every operation begins with it.
void catch_up(Self self);

/// Why the client's leases, or those of others, forbid a write.
std::optional<Failure> check_leases(const WorkingMemoryState& state, const WriteRequest& request);

/// Answers those whose waits were settled.
void settle(Self self);

/// Sees to it that `catch_up` is called when something is due.
void set_alarm(Self self);

/// The sender of the current message is this client; it is watched from now on. To be called before
/// the message's response promise is made, which takes the sender.
void remember_client(Self self, const ClientPtr& client);

/// What the client held is free, and what it owned goes.
void end_client(Self self, const caf::actor_addr& who);

caf::result<Outcome<EntryPtr>> read(Self self, const ReadRequest& request);
caf::result<Outcome<std::vector<EntryPtr>>> query(Self self, const QueryRequest& request);
caf::result<Outcome<Lease>> lock(Self self, const LockRequest& request);
Outcome<Acknowledged> unlock(Self self, const UnlockRequest& request);
void cancel(Self self, const CancelWait& request);
RenewReply renew(Self self, const RenewRequest& request);
Outcome<LockStatus> lock_status(const WorkingMemoryState& state, const Address& address);
void follow(Self self, DeadlockProbe probe);

// -- change events

/// An event that is to be told, which has all but the fields that changed.
struct Change {
  std::shared_ptr<ChangeEvent> event;
  /// Of the entry: the new one, or that before its deletion.
  Value content;
  /// Before an overwrite.
  EntryPtr before;
};

/// Sends the events of one write to the components and working memories that want them.
void emit(Self self, const std::vector<Change>& changes);
void receive_forwarded(Self self, const ForwardedEvents& forwarded);
caf::result<Outcome<Acknowledged>> subscribe(Self self, const Subscribe& request);
void unsubscribe(Self self, const Unsubscribe& request);
void acknowledge(Self self, const EventsTaken& taken);
void set_interest(WorkingMemoryState& state, const Interest& interest);
void end_subscriber(Self self, const caf::actor_addr& who);

} // namespace castor::working_memory_parts
