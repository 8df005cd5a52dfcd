#pragma once

#include "castor/wm/memory/event_dispatcher.hpp"
#include "castor/wm/memory/journal_outbox.hpp"
#include "castor/wm/memory/lease_service.hpp"
#include "castor/wm/memory/monitored_actors.hpp"
#include "castor/wm/memory/working_memory_options.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"
#include "castor/wm/store/entry_store.hpp"
#include "castor/wm/store/usage_log.hpp"

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor {

/// Operations of a working memory's clients: checks them with the store and the leases, commits,
/// and has the events sent. Every call handles the actor's current message.
class WorkingMemoryShell {
public:
  WorkingMemoryShell(WorkingMemoryActor::pointer self, const WorkingMemoryOptions& options);
  WorkingMemoryShell(const WorkingMemoryShell&) = delete;
  WorkingMemoryShell& operator=(const WorkingMemoryShell&) = delete;
  ~WorkingMemoryShell();

  /// Answers a request for this working memory, delegates one for another.
  template <class Reply, class Request, class F>
  caf::result<Outcome<Reply>> at_owner(const Address& address, const Request& request, F&& answer) {
    if (address.subarchitecture == store_.subarchitecture())
      return outbox_.reply<Outcome<Reply>>(answer());
    if (auto* peer = events_.find_peer(address.subarchitecture))
      return self_->delegate(*peer, request);
    return Outcome<Reply>{events_.unknown_subarchitecture(address)};
  }

  // -- operations on the entries here

  Outcome<Version> write(const WriteRequest& request);
  Outcome<std::vector<Version>> write_all(const BatchRequest& request);
  caf::result<Outcome<EntryPtr>> read(const ReadRequest& request);
  caf::result<Outcome<std::vector<EntryPtr>>> query(const QueryRequest& request);
  Outcome<bool> exists(const ExistsQuery& request);
  Outcome<Version> version(const VersionQuery& request);
  caf::result<Outcome<Lease>> lock(const LockRequest& request);
  Outcome<Acknowledged> unlock(const UnlockRequest& request);
  Outcome<LockStatus> lock_status(const LockQuery& request);

  // -- other operations

  /// Refused if the subarchitecture may not read here.
  Outcome<Acknowledged> set_interest(const Interest& interest);

  void claim(const ClaimLease& request);
  void cancel(const CancelWait& request);
  caf::result<RenewReply> renew(const RenewRequest& request);
  void follow(DeadlockProbe probe);

  /// Subarchitectures whose components may write here from now on; "*" for all.
  void allow_writers(const std::set<std::string>& writers);

  /// Handles leases, waits and entries that are due.
  void wake_up();
  void jump_clock(Timestamp by);

  /// A monitored actor has ended.
  void end(const caf::actor_addr& who);

  WorkingMemoryStatus status() const;
  UsageReport usage() const;

  EventDispatcher& events() { return events_; }
  JournalOutbox& outbox() { return outbox_; }

private:
  /// Time since the system began, simulated if its clock is.
  Timestamp now() const;
  /// The same by the real clock, by which leases and waits are timed.
  Timestamp lease_now() const;

  /// Counts refusals.
  std::optional<Failure> check_may_read(const ClientPtr& client, const Address& address);

  /// Ends leases, waits and entries that are due. Every operation begins with it.
  void catch_up();
  /// Until when those who read without a message need not ask.
  void tell_readers();
  void delete_due(Timestamp now);

  /// Applies effects that were prepared together, and sends their events.
  void commit(std::vector<EntryStore::Effect> effects);

  /// Replies to clients whose waits have ended.
  void settle();

  /// Schedules the next calls of `wake_up`.
  void set_alarm();
  void set_lease_alarm(Timestamp next);
  void set_system_alarm(Timestamp next);

  /// Remembers that the sender of the current message is this client, and monitors it. To be called
  /// before the message's response promise is made, which takes the sender.
  void remember_client(const ClientPtr& client);

  /// Forwards a message without an answer if it is about an entry of another working memory.
  template <class Message>
  bool is_for_peer(const Address& address, const Message& message) {
    if (address.subarchitecture == store_.subarchitecture())
      return false;
    if (auto* peer = events_.find_peer(address.subarchitecture))
      self_->send(*peer, message);
    return true;
  }

  /// Releases its leases, expires its entries.
  void end_client(const caf::actor_addr& who);
  caf::actor actor_of(const Client& client) const;

  void count_change(const ChangeEvent& event);
  void count_read(const ClientPtr& client, const Entry& entry);

  WorkingMemoryActor::pointer self_;
  MonitoredActors monitored_{self_};
  JournalOutbox outbox_{self_};
  EntryStore store_;
  LeaseService leases_;
  UsageLog usage_;
  EventDispatcher events_;

  std::chrono::steady_clock::time_point epoch_;
  /// Null for the real clock.
  std::shared_ptr<SimulatedClock> clock_;
  /// Clock error, injected by `jump_clock`.
  Timestamp clock_jump_{0};
  /// Times of the next WakeUp by the clock of leases, and by the simulated one.
  Timestamp lease_alarm_ = Timestamp::max();
  Timestamp system_alarm_ = Timestamp::max();
  SimulatedClock::Key system_alarm_key_;
  /// Clients that hold a lease here, wait, or own an entry.
  std::map<caf::actor_addr, ClientPtr> clients_;
  Timestamp last_event_{0};
  /// Number of refused operations.
  std::uint64_t refused_ = 0;
};

} // namespace castor
