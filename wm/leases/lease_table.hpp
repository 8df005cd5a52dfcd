#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/lease.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

struct LeaseTableOptions {
  /// How long a lease lasts without a renewal.
  Timestamp duration = std::chrono::seconds{2};
  /// Tokens rise from here. A table that takes over from another starts above it.
  LeaseToken first_token = 1;
};

/// How a wait ended.
struct SettledWait {
  enum class Result : std::uint8_t { granted, readable, timed_out, deleted };

  ClientPtr client;
  WaitNumber number = 0;
  Result result = Result::granted;
  /// Where one was granted.
  Lease lease;
};

/// The leases of one working memory, and who waits for them.
///
/// Lock waits and reads of an entry that is leased at level ODR stand in one queue per entry, first
/// come, first served. When a lease ends, the queue is served from its front: up to the first lock
/// wait, which gets the lease, and from then on only reads that the new lease allows.
///
/// Time is passed in. Every function but `expire` takes leases as they stand: call `expire` first.
/// What other waits became of a call is collected and taken with `take_settled`.
class LeaseTable {
public:
  struct Waiter {
    ClientPtr client;
    WaitNumber number = 0;
    /// Nothing for a read.
    std::optional<LockLevel> level;
    Timestamp deadline{0};
    /// Counts the waits of the table.
    std::uint64_t arrival = 0;
  };

  struct Holding {
    Lease lease;
    ClientPtr holder;
    /// The holder's number for the operation that obtained it.
    WaitNumber number = 0;
    /// The levels asked for and not given back yet; that of the lease is the strongest.
    std::vector<LockLevel> levels;
  };

  enum class Verdict : std::uint8_t {
    permitted,
    /// Somebody else holds a lease that forbids it.
    leased,
    /// The token is not that of the entry's lease.
    stale,
  };

  explicit LeaseTable(LeaseTableOptions options = {}) : options_(options) {
    next_token_ = options.first_token;
  }

  /// The tables point into one another, so a lease table moves but is never copied.
  LeaseTable(LeaseTable&&) = default;
  LeaseTable& operator=(LeaseTable&&) = default;

  /// No leases and no waits.
  bool empty() const { return rows_.empty(); }

  /// The lease, if the entry is free or the client holds it already: then the same token, to be
  /// released as often as it was obtained.
  std::optional<Lease> try_lock(const std::string& id, const ClientPtr& client, LockLevel level,
                                WaitNumber number, Timestamp now);

  /// Like `try_lock`; otherwise the wait is queued until the deadline.
  std::optional<Lease> lock(const std::string& id, const ClientPtr& client, LockLevel level,
                            WaitNumber number, Timestamp now, Timestamp deadline);

  /// Whether the client may read now.
  bool may_read(const std::string& id, const Client& client) const;

  /// Queues a read that may not happen now.
  void wait_to_read(const std::string& id, const ClientPtr& client, WaitNumber number,
                    Timestamp deadline);

  /// Whether a write may happen; `token` is that of the lease that the client believes to hold, or
  /// 0.
  Verdict check(const std::string& id, const Client& client, Operation operation,
                LeaseToken token) const;

  /// Gives back one level; false if the token is not that of the entry's lease.
  bool unlock(const std::string& id, const Client& client, LeaseToken token, Timestamp now);

  /// Extends the lease; false if the token is not that of the entry's lease.
  bool renew(const std::string& id, const Client& client, LeaseToken token, Timestamp now);

  /// Takes a wait back, or gives up the lease that it obtained meanwhile.
  void cancel(const std::string& id, const Client& client, WaitNumber number, Timestamp now);

  /// The client is gone: its leases end and its waits are forgotten.
  void drop(const Client& client, Timestamp now);

  /// The entry was deleted: its lease ends, and every wait for it fails.
  void erase(const std::string& id);

  /// Ends leases that were not renewed and waits whose deadline has passed.
  void expire(Timestamp now);

  /// When `expire` will next have something to do.
  std::optional<Timestamp> next_deadline() const;

  /// The waits that were settled since the last call, in the order of their settlement.
  std::vector<SettledWait> take_settled() { return std::exchange(settled_, {}); }

  /// The entry's lease, or null.
  const Holding* holding(const std::string& id) const;

  /// Those who wait for the entry, the longest waiting first; null if nobody does.
  const std::deque<Waiter>* waiting(const std::string& id) const;

  /// How many leases there are.
  std::size_t size() const { return expiries_.size(); }

private:
  /// Only a leased entry has waits.
  struct Row {
    std::optional<Holding> holding;
    std::deque<Waiter> queue;
    /// Valid while there is a holding.
    std::multimap<Timestamp, std::string>::iterator expiry;
  };
  using Rows = std::unordered_map<std::string, Row>;

  bool is_holder(const Row& row, const Client& client, LeaseToken token) const;
  const Lease& grant(Rows::iterator row, const ClientPtr& client, LockLevel level,
                     WaitNumber number, Timestamp now);
  void end_lease(Rows::iterator row, Timestamp now);
  void serve(Rows::iterator row, Timestamp now);
  /// Serves the reads that the lease allows.
  void serve_reads(Row& row);
  void enqueue(Rows::iterator row, Waiter waiter);
  void settle(const Waiter& waiter, SettledWait::Result result, Lease lease = {});
  /// Takes the waits that `unwanted` picks out of the queue.
  template <class F>
  void forget_waits(Row& row, F&& unwanted);
  void remove_if_idle(Rows::iterator row);

  LeaseTableOptions options_;
  LeaseToken next_token_;
  Rows rows_;
  /// Leased entries, the next to expire first. That is the one that was renewed first, unless the
  /// clock has been put back since.
  std::multimap<Timestamp, std::string> expiries_;
  /// The waits by deadline and arrival, with the ids of their entries.
  std::map<std::pair<Timestamp, std::uint64_t>, std::string> deadlines_;
  std::uint64_t arrivals_ = 0;
  std::vector<SettledWait> settled_;
};

} // namespace castor
