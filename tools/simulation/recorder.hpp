#pragma once

#include "castor/tools/linearizability/history.hpp"
#include "castor/tools/simulation/lock_order.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace castor::linearizability {

/// Records the operations and results of the clients of one simulation, and computes bounds for the
/// ends of their leases.
class Recorder {
public:
  using Index = std::size_t;

  /// @param lease_duration of a lease without a renewal
  explicit Recorder(Timestamp lease_duration) : lease_duration_(lease_duration) {}

  Tick tick() { return ++tick_; }

  /// Time has passed.
  void set_time(Timestamp now);
  Timestamp now() const { return advances_.empty() ? Timestamp{0} : advances_.back().first; }

  // -- operations

  Index invoked(OperationRecord x);
  /// An operation at time `at` of which only now is known that it is on this entry.
  Index invoked(OperationRecord x, Tick at);
  void returned(Index x, const Result& result);
  /// The working memory has received it by now.
  void known_to_have_arrived(Index x);
  /// It was refused for a reason that has nothing to do with this entry, such as another write of
  /// its batch.
  void did_not_happen(Index x);

  const OperationRecord& operator[](Index x) const { return operations_[x].record; }
  bool happened(Index x) const { return !operations_[x].dropped; }
  std::size_t size() const { return operations_.size(); }

  // -- leases

  /// A lock was granted, perhaps a nested one.
  void obtained(Index lock);
  /// A renewal was sent.
  void renewing(std::uint32_t entry, Token token);
  /// A renewal sent at this time succeeded.
  void renewed(std::uint32_t entry, Token token, Timestamp sent);
  void not_renewed(std::uint32_t entry, Token token);
  /// From this time on the lease may end, other than by an unlock.
  void may_end(std::uint32_t entry, Token token, Tick from);
  /// The lease has ended by now.
  void has_ended(std::uint32_t entry, Token token);
  /// The client has ended: its leases may end from now on, and its waiting operations are never
  /// answered.
  void died(Client client);
  /// Other processes may consider this running client ended: its leases may end from now on.
  void may_be_lost(Client client);
  /// Every working memory knows by now of the end of every client.
  void deaths_are_known();

  /// Between these times a working memory ended and was replaced by one that may lack changes of
  /// the entry. `begin` is the entry's state in the replacement.
  void lost(std::uint32_t entry, Tick from, Tick to, const Result& begin);

  /// Between these times a working memory ended and was replaced by one that has its entries, but
  /// not its leases: those with tokens below `below` have ended.
  void leases_lost(std::uint32_t entry, Token below, Tick from, Tick to);
  /// The clock of the entry's leases jumped forward or back.
  void clock_jumped(std::uint32_t entry, Timestamp by);

  /// Waiting locks may be overtaken, for so long: in the history a lock may reach its working
  /// memory at any time, and the order of locks is checked for itself.
  void set_overtaking(Timestamp x) { overtaking_ = x; }
  LockOrder lock_order() const;

  /// The whole history; to be called when no operation is under way any more.
  History finish();

private:
  struct Operation {
    OperationRecord record;
    Timestamp sent{0};
    bool dropped = false;
    /// When it was known to have reached its working memory.
    Tick arrived_by = never;
  };

  struct Lease {
    Client holder = 0;
    /// Time at which its lock was invoked.
    Tick invoked = 0;
    /// Bounds for the time at which it expires without a further renewal.
    Timestamp lasts_until{0};
    Timestamp over_by{0};
    std::size_t renewals_under_way = 0;
    Tick may_end_from = never;
    Tick ended_by = never;
  };

  /// The first tick at or after this time.
  Tick first_tick_at(Timestamp time) const;
  Timestamp time_at(Tick tick) const;
  OperationRecord lapse_of(std::uint32_t entry, Token token, const Lease& lease);

  struct Restart {
    std::uint32_t entry = 0;
    Tick from = 0;
    Tick to = 0;
  };

  struct Jump {
    std::uint32_t entry = 0;
    Tick at = 0;
    Timestamp by{0};
  };

  Timestamp lease_duration_;
  Timestamp overtaking_{0};
  Tick tick_ = 0;
  std::vector<std::pair<Timestamp, Tick>> advances_;
  std::vector<Operation> operations_;
  /// By entry and token.
  std::map<std::pair<std::uint32_t, Token>, Lease> leases_;
  std::map<Client, Tick> deaths_;
  std::map<Client, Tick> may_be_lost_;
  /// Restarts of working memories that kept their entries.
  std::vector<Restart> restarts_;
  std::vector<Jump> jumps_;
};

} // namespace castor::linearizability
