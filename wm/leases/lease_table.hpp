#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/entries/lease.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// Called when an entry gets a lease that keeps others from reading it, and when that ends.
using ExclusionObserver = std::function<void(const std::string& id, bool is_excluded)>;

struct LeaseTableOptions {
  /// Duration of a lease without renewal.
  Timestamp duration = std::chrono::seconds{2};
  /// First token; tokens increase. A table that replaces another one starts above its tokens.
  LeaseToken first_token = 1;
  /// How long clients may overtake the one that has waited longest, until that one is awake. 0 for
  /// not at all.
  Timestamp overtaking = std::chrono::microseconds{500};
  /// Called before the lease is returned or its wait settled; not when the entry is deleted. May be
  /// empty.
  ExclusionObserver on_exclusion = {};
};

/// Result of a wait that has ended.
struct SettledWait {
  enum class Result : std::uint8_t { granted, readable, timed_out, deleted };

  ClientPtr client;
  WaitNumber number = 0;
  Result result = Result::granted;
  /// The lease, if one was granted.
  Lease lease;
};

/// A free lease that the client may claim for its wait; others may get it before.
struct OfferedLease {
  ClientPtr client;
  WaitNumber number = 0;
};

/// The leases of one working memory, and the clients that wait for them.
///
/// Lock requests and reads of an entry that is leased at level ODR wait in one queue per entry,
/// first come, first served. When a lease ends, the queue is served from its front: up to the first
/// lock request, which gets the lease, and after it only reads that the new lease allows.
///
/// A waiting client sleeps, and a lease that waits until its client is awake is of use to nobody.
/// So a client that can claim is only offered the lease: the entry is free, and its reads are
/// served, until the client claims the lease or another one requests it, which thus overtakes. A
/// client that claims in vain gets the lease when it ends next. From the first offer to the end of
/// overtaking passes a bounded time, after which the queue is served as it stands; the next time
/// begins after a lock request from the queue was granted. A client that waits itself overtakes
/// nobody: its request ends overtaking.
///
/// Time is passed in. Only `expire` ends leases and waits that are over: call it before every other
/// function. Waits that end by a call are collected for `take_settled`.
class LeaseTable {
public:
  struct Waiter {
    ClientPtr client;
    WaitNumber number = 0;
    /// Requested level; nothing for a read.
    std::optional<LockLevel> level;
    Timestamp deadline{0};
    /// Number of the wait in the table, in order of arrival.
    std::uint64_t arrival = 0;
    /// Whether the client claims what it is offered.
    bool can_claim = false;
    bool was_offered = false;
    /// The client is awake, but the lease was another's when it claimed.
    bool has_claimed = false;
  };

  struct Holding {
    Lease lease;
    ClientPtr holder;
    /// Number that the holder gave to the operation that obtained the lease.
    WaitNumber number = 0;
    /// Levels requested and not released yet; the lease has the strongest of them.
    std::vector<LockLevel> levels;
  };

  enum class Verdict : std::uint8_t {
    permitted,
    /// Another client holds a lease that forbids it.
    leased,
    /// The token is not that of the entry's lease.
    stale,
  };

  explicit LeaseTable(LeaseTableOptions options = {})
    : options_(std::move(options)), next_token_(options_.first_token) {}

  /// The tables point into one another, so a lease table moves but is never copied.
  LeaseTable(LeaseTable&&) = default;
  LeaseTable& operator=(LeaseTable&&) = default;

  /// No leases and no waits.
  bool empty() const { return rows_.empty(); }

  /// Returns a lease if the entry is free or leased by the client itself. In the latter case the
  /// token is the same, and has to be released as often as it was obtained.
  std::optional<Lease> try_lock(const std::string& id, const ClientPtr& client, LockLevel level,
                                WaitNumber number, Timestamp now);

  /// Like `try_lock`; if there is no lease, queues the request until the deadline.
  std::optional<Lease> lock(const std::string& id, const ClientPtr& client, LockLevel level,
                            WaitNumber number, Timestamp now, Timestamp deadline,
                            bool can_claim = false);

  /// The client is awake and claims what it was offered.
  void claim(const std::string& id, const Client& client, WaitNumber number, Timestamp now);

  /// Whether the client may read now.
  bool may_read(const std::string& id, const Client& client) const;

  /// Queues a read that is not allowed now.
  void wait_to_read(const std::string& id, const ClientPtr& client, WaitNumber number,
                    Timestamp deadline);

  /// Whether a write is allowed; `token` is that of the lease that the client believes it holds, or
  /// 0.
  Verdict check(const std::string& id, const Client& client, Operation operation,
                LeaseToken token) const;

  /// Releases one level; false if the token is not that of the entry's lease.
  bool unlock(const std::string& id, const Client& client, LeaseToken token, Timestamp now);

  /// Extends the lease; false if the token is not that of the entry's lease.
  bool renew(const std::string& id, const Client& client, LeaseToken token, Timestamp now);

  /// Cancels a wait, or releases the lease that it has obtained meanwhile.
  void cancel(const std::string& id, const Client& client, WaitNumber number, Timestamp now);

  /// The client has ended: releases its leases and removes its waits.
  void drop(const Client& client, Timestamp now);

  /// The entry was deleted: its lease ends, and every wait for it fails.
  void erase(const std::string& id);

  /// Ends leases that were not renewed, waits whose deadline has passed, and overtaking.
  void expire(Timestamp now);

  /// Time of the next lease expiry, wait deadline or end of overtaking.
  std::optional<Timestamp> next_deadline() const;

  /// The waits that were settled since the last call, in the order of their settlement.
  std::vector<SettledWait> take_settled() { return std::exchange(settled_, {}); }

  /// The offers that were made since the last call.
  std::vector<OfferedLease> take_offers() { return std::exchange(offers_, {}); }

  /// The entry's lease, or null.
  const Holding* holding(const std::string& id) const;

  /// Waits for the entry, the longest first; null if there are none.
  const std::deque<Waiter>* waiting(const std::string& id) const;

  /// Number of leases.
  std::size_t size() const { return expiries_.size(); }

private:
  /// An entry with a lease, or one that waits were offered.
  struct Row {
    std::optional<Holding> holding;
    std::deque<Waiter> queue;
    /// Valid while there is a holding.
    std::multimap<Timestamp, std::string>::iterator expiry;
    /// As the observer was told last.
    bool is_excluded = false;
    /// End of overtaking; nothing if there was no offer since a wait was granted.
    std::optional<Timestamp> overtaken_until;
  };
  using Rows = std::unordered_map<std::string, Row>;

  bool is_holder(const Row& row, const Client& client, LeaseToken token) const;
  const Lease& grant(Rows::iterator row, const ClientPtr& client, LockLevel level,
                     WaitNumber number, Timestamp now);
  void end_lease(Rows::iterator row, Timestamp now);
  /// Tells the observer if that has changed.
  void note_exclusion(Rows::iterator row);
  void serve(Rows::iterator row, Timestamp now);
  /// Serves the reads that the lease allows, or all if there is none.
  void serve_reads(Row& row);
  /// Whether the first wait, for a lease, is to be offered it rather than granted.
  bool may_be_overtaken(const Row& row, Timestamp now) const;
  void offer_lease(Rows::iterator row, Timestamp now);
  void grant_first(Rows::iterator row, Timestamp now);
  void end_overtaking(Rows::iterator row);
  void enqueue(Rows::iterator row, Waiter waiter);
  void settle(const Waiter& waiter, SettledWait::Result result, Lease lease = {});
  /// Removes the waits from the queue for which `unwanted` returns true.
  template <class F>
  void forget_waits(Row& row, F&& unwanted);
  void remove_if_idle(Rows::iterator row);

  LeaseTableOptions options_;
  LeaseToken next_token_;
  Rows rows_;
  /// Leased entries, the next to expire first: the one renewed first, unless the clock was set back
  /// since.
  std::multimap<Timestamp, std::string> expiries_;
  /// The waits by deadline and arrival, with the ids of their entries.
  std::map<std::pair<Timestamp, std::uint64_t>, std::string> deadlines_;
  /// Ends of overtaking, with the ids of the entries.
  std::set<std::pair<Timestamp, std::string>> overtakings_;
  std::uint64_t arrivals_ = 0;
  std::vector<SettledWait> settled_;
  std::vector<OfferedLease> offers_;
};

} // namespace castor
