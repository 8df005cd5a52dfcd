#pragma once

#include "castor/wm/memory/working_memory.hpp"

#include <map>
#include <memory>
#include <optional>
#include <vector>

/// What the working memory actor is put together from; of no use outside.
namespace castor::working_memory_parts {

using Self = WorkingMemoryActor::stateful_pointer<WorkingMemoryState>;

/// Time since the system began.
Timestamp now(Self self);

/// Null if there is no such subarchitecture, or if it is the own one.
const WorkingMemoryActor* find_peer(const WorkingMemoryState& state, const std::string& name);

Failure unknown_subarchitecture(const WorkingMemoryState& state, const Address& address);

/// An answer that somebody waits for. If it is never given, because the working memory ends before,
/// they hear that.
template <class Reply>
class DeferredReply {
public:
  explicit DeferredReply(caf::typed_response_promise<Reply> promise)
    : promise_(std::move(promise)) {}
  DeferredReply(const DeferredReply&) = delete;
  DeferredReply& operator=(const DeferredReply&) = delete;
  ~DeferredReply() {
    if (wanted_ && promise_.pending())
      promise_.deliver(caf::make_error(caf::sec::request_receiver_down));
  }

  void deliver(Reply x) { promise_.deliver(std::move(x)); }

  /// Nobody wants it any more.
  void forgo() { wanted_ = false; }

  const caf::typed_response_promise<Reply>& promise() const { return promise_; }

private:
  caf::typed_response_promise<Reply> promise_;
  bool wanted_ = true;
};

template <class Reply>
using DeferredReplyPtr = std::shared_ptr<DeferredReply<Reply>>;

/// The answer to the current message is given later.
template <class Reply>
DeferredReplyPtr<Reply> defer(Self self) {
  return std::make_shared<DeferredReply<Reply>>(self->template make_response_promise<Reply>());
}

/// Says something that others may conclude from what has happened to entries: not before that is
/// safe in the journal.
template <class F>
void emit_after_sync(Self self, F&& f) {
  auto& gate = self->state.gate;
  if (gate.holds())
    gate.push(std::forward<F>(f));
  else
    f();
}

/// The same of the answer to the current message.
template <class Reply>
caf::result<Reply> say_reply(Self self, caf::result<Reply> reply) {
  auto& gate = self->state.gate;
  if (!gate.holds() || reply.flag != caf::rt_value)
    return reply;
  auto answer = defer<Reply>(self);
  gate.push([answer, message = std::move(reply.value)] {
    answer->deliver(Reply{message.template get_as<Reply>(0)});
  });
  return answer->promise();
}

/// And of an answer that has waited.
template <class Reply>
void say_reply(Self self, DeferredReplyPtr<Reply> answer, Reply reply) {
  emit_after_sync(self, [answer = std::move(answer), reply = std::move(reply)]() mutable {
    answer->deliver(std::move(reply));
  });
}

/// Answers here what is ours, hands on what is another working memory's.
template <class Reply, class Request, class F>
caf::result<Outcome<Reply>> at_owner(Self self, const Address& address, const Request& request,
                                     F&& answer) {
  auto& state = self->state;
  if (address.subarchitecture == state.options.subarchitecture) {
    auto reply = answer();
    if (!state.gate.holds())
      return reply;
    return say_reply<Outcome<Reply>>(self, std::move(reply));
  }
  if (auto* peer = find_peer(state, address.subarchitecture))
    return self->delegate(*peer, request);
  return Outcome<Reply>{unknown_subarchitecture(state, address)};
}

/// Learns of the end of an actor; once is enough.
void monitor(Self self, const caf::strong_actor_ptr& who);

// -- changes

/// An event that is to be told, which has all but the fields that changed.
struct Change {
  std::shared_ptr<ChangeEvent> event;
  /// As it is now, or was before its deletion.
  EntryPtr entry;
  /// Before an overwrite.
  EntryPtr before;
};

/// Applies effects that were prepared together, and tells everybody who wants to know.
void commit(Self self, std::vector<EntryStore::Effect> effects);

// -- journal (working_memory_journal.cpp)

/// Takes up what the journal holds, as the first thing.
void begin_journal(Self self);

/// The changes of one write are to be in the journal before anybody hears of them.
void write_down(Self self, const std::vector<Change>& changes);
void hear_of_journal(Self self, const JournalNews& news);

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

/// Keys of the filter indices: the number of a subscriber or a peer, above that of its filter or
/// interest.
inline FilterIndex::Key key_of(std::uint32_t number, std::uint32_t id) {
  return static_cast<FilterIndex::Key>(number) << 32 | id;
}

/// Calls `f` with each subscriber or peer and its filters or interests, of keys in order.
template <class F>
void for_each_receiver(const std::vector<FilterIndex::Key>& keys, F&& f) {
  for (std::size_t i = 0; i < keys.size();) {
    auto number = static_cast<std::uint32_t>(keys[i] >> 32);
    std::vector<std::uint32_t> ids;
    for (; i < keys.size() && keys[i] >> 32 == number; ++i)
      ids.push_back(static_cast<std::uint32_t>(keys[i]));
    f(number, std::move(ids));
  }
}

/// Sends the events of one write to the components and working memories that want them.
void emit(Self self, const std::vector<Change>& changes);
void receive_forwarded(Self self, const ForwardedEvents& forwarded);
caf::result<Outcome<Acknowledged>> subscribe(Self self, const Subscribe& request);
void unsubscribe(Self self, const Unsubscribe& request);
void acknowledge(Self self, const EventsTaken& taken);
void set_interest(WorkingMemoryState& state, const caf::actor_addr& from, const Interest& interest);

/// Whether a filter can match events of another working memory.
bool concerns(const ChangeFilter& filter, const WorkingMemoryState::Peer& peer);

/// Tells another working memory what is wanted of it, or is not any more; to be followed by `then`.
inline auto tell_interest(Self self, const WorkingMemoryState::Peer& peer,
                          const ChangeFilter& filter, InterestId id, bool wanted) {
  auto& options = self->state.options;
  return self->request(peer.actor, options.peer_deadline,
                       Interest{options.subarchitecture, id, filter, wanted});
}

// -- other working memories (working_memory_routes.cpp)

caf::result<Acknowledged> introduce(Self self, const Peers& peers);

/// What each of the other working memories is to be told of the events of one write.
class ForwardedChanges {
public:
  explicit ForwardedChanges(Self self) : self_(self) {}

  /// `keys` are those of `WorkingMemoryState::peer_index`, sorted.
  void add(const ChangeEventPtr& event, const std::vector<FilterIndex::Key>& keys);
  void send();

private:
  Self self_;
  /// By peer, for those in this process.
  std::map<std::uint32_t, std::vector<ForwardedEvent>> near_;
  /// By route.
  std::map<std::size_t, EventFlow::Batch> far_;
};

/// The sender, a route, can take more.
void acknowledge_route(Self self, std::size_t route, std::uint64_t count);
std::optional<std::size_t> find_route(const WorkingMemoryState& state, const caf::actor_addr& who);

/// The process at the end of the route is lost.
void end_route(Self self, const caf::actor_addr& who);
void end_subscriber(Self self, const caf::actor_addr& who);

} // namespace castor::working_memory_parts
