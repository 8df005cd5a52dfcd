#pragma once

#include "castor/wm/leases/deadlock_probe.hpp"
#include "castor/wm/leases/lease_table.hpp"
#include "castor/wm/memory/working_memory_messages.hpp"
#include "castor/wm/store/entry_store.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace castor {

/// The answer to an operation that waits.
template <class Reply>
struct WaitingReply {
  std::function<void(Outcome<Reply>)> deliver;
  /// The client waits no longer: nothing is to be delivered.
  std::function<void()> abandon;
  /// Offers the client the lease that it waits for; empty if the client does not claim.
  std::function<void()> offer = {};
};

/// Locks and reads of the entries of one working memory: the operations that wait for a lease to
/// end, and the failures of those that must not wait, or waited in vain.
///
/// Time is passed in. Every function but `expire` takes leases as they stand: call `expire` first.
/// Waits of others that a call ends are answered by `settle`.
class LeaseService {
public:
  using Entries = std::vector<EntryPtr>;

  LeaseService(const EntryStore& store, LeaseTableOptions options)
    : store_(store), table_(std::move(options)) {}

  /// Waits refer to the service.
  LeaseService(const LeaseService&) = delete;
  LeaseService& operator=(const LeaseService&) = delete;

  // -- operations: a result, or nothing if the client has to wait

  /// Refused at once if the request has no patience.
  std::optional<Outcome<Lease>> try_lock(const LockRequest& request, Timestamp now);
  void wait_to_lock(const LockRequest& request, Timestamp now, WaitingReply<Lease> reply);

  std::optional<Outcome<EntryPtr>> try_read(const ReadRequest& request) const;
  void wait_to_read(const ReadRequest& request, Timestamp now, WaitingReply<EntryPtr> reply);

  std::optional<Entries> try_query(const QueryRequest& request) const;
  /// Waits for one lease after the other, until all entries can be read at once.
  void wait_to_query(const QueryRequest& request, Timestamp now, WaitingReply<Entries> reply);

  Outcome<Acknowledged> unlock(const UnlockRequest& request, Timestamp now);
  RenewReply renew(const RenewRequest& request, Timestamp now);
  void claim(const ClaimLease& request, Timestamp now);
  void cancel(const CancelWait& request, Timestamp now);
  Outcome<LockStatus> status(const Address& address) const;

  // -- rules

  /// Why the client's leases, or those of others, forbid a write.
  std::optional<Failure> check(const WriteRequest& request) const;

  /// Until when nobody but the holder of its lease may delete the entry.
  std::optional<Timestamp> protected_until(const std::string& id) const;

  /// The client that could end the wait of a deadlock probe's last edge, or null. Completes the
  /// edge: which entry it is for, and what stands in the way.
  ClientPtr follow(WaitEdge& edge) const;

  // -- ends

  void expire(Timestamp now) { table_.expire(now); }

  /// The client is gone: its leases end, its waits are not answered.
  void drop(const Client& client, Timestamp now);

  /// The entry was deleted.
  void erase(const std::string& id) { table_.erase(id); }

  /// Answers the waits that have ended, and makes offers to others; false if there were none.
  bool settle();

  /// When `expire` will next have something to do.
  std::optional<Timestamp> next_deadline() const { return table_.next_deadline(); }

  /// No leases and no waits.
  bool empty() const { return table_.empty(); }

  /// How many leases there are, and how many waits.
  std::size_t size() const { return table_.size(); }
  std::size_t waiting() const { return waits_.size(); }

private:
  /// Component, incarnation, number.
  using WaitKey = std::tuple<std::string, std::uint64_t, WaitNumber>;

  struct Wait {
    std::string id;
    std::function<void(const SettledWait&)> finish;
    std::function<void()> abandon;
    std::function<void()> offer = {};
  };

  struct PendingQuery {
    TypeQuery query;
    ClientPtr client;
    WaitNumber number = 0;
    Timestamp deadline{0};
    WaitingReply<Entries> reply;
  };

  static WaitKey key_of(const Client& client, WaitNumber number);

  Failure failed_wait(const SettledWait& settled, const ClientPtr& client, const Address& address,
                      const std::string& verb) const;
  /// "X holds a lease of level O on it", or "nobody holds one".
  std::string describe_holder(const std::string& id) const;
  /// The first entry that the client has to wait for, or null.
  EntryPtr first_unreadable(const Entries& entries, const ClientPtr& client) const;
  void resume(const std::shared_ptr<PendingQuery>& pending);

  const EntryStore& store_;
  LeaseTable table_;
  std::map<WaitKey, Wait> waits_;
};

} // namespace castor
