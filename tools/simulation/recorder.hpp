#pragma once

#include "castor/tools/linearizability/history.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace castor::linearizability {

/// Writes down what the clients of one simulation do and see, and works out what is known of the
/// ends of their leases.
class Recorder {
public:
  using Index = std::size_t;

  /// How long a lease lasts without a renewal.
  explicit Recorder(Timestamp lease_duration) : lease_duration_(lease_duration) {}

  Tick tick() { return ++tick_; }

  /// Time has passed.
  void set_time(Timestamp now);
  Timestamp now() const { return advances_.empty() ? Timestamp{0} : advances_.back().first; }

  // -- operations

  Index invoked(OperationRecord x);
  /// One that is known only now to concern this entry.
  Index invoked(OperationRecord x, Tick at);
  void returned(Index x, const Result& result);
  /// The working memory is known to have it by now.
  void known_to_have_arrived(Index x);
  /// It was refused as a whole, for a reason that lies elsewhere.
  void did_not_happen(Index x);

  const OperationRecord& operator[](Index x) const { return operations_[x].record; }
  bool happened(Index x) const { return !operations_[x].dropped; }
  std::size_t size() const { return operations_.size(); }

  // -- leases

  /// A lock was granted; again, if its holder had it already.
  void obtained(Index lock);
  /// A renewal is on its way.
  void renewing(std::uint32_t entry, Token token);
  /// It succeeded; it was sent at that time.
  void renewed(std::uint32_t entry, Token token, Timestamp sent);
  void not_renewed(std::uint32_t entry, Token token);
  /// From that moment on the lease may be given up, not by an unlocking.
  void may_end(std::uint32_t entry, Token token, Tick from);
  /// The lease is over by now.
  void has_ended(std::uint32_t entry, Token token);
  /// The client's leases may end from now on; what it waits for is never answered.
  void died(Client client);
  /// The same of a client that others may take for dead, and that lives.
  void may_be_lost(Client client);
  /// Every working memory has heard of every death.
  void deaths_are_known();

  /// A working memory ended and another took its place, which need not know what has happened to
  /// the entry, between these moments. It begins with that.
  void lost(std::uint32_t entry, Tick from, Tick to, const Result& begin);

  /// A working memory ended and another took its place, which has its entries, but not its leases:
  /// those with tokens below that ended between these moments.
  void leases_lost(std::uint32_t entry, Token below, Tick from, Tick to);
  /// The clock by which the entry's leases end jumps forward, or back.
  void clock_jumped(std::uint32_t entry, Timestamp by);

  /// All that happened; to be called when nothing is under way any more.
  History finish();

private:
  struct Operation {
    OperationRecord record;
    Timestamp sent{0};
    bool dropped = false;
  };

  struct Lease {
    Client holder = 0;
    /// When its lock was invoked.
    Tick invoked = 0;
    /// When it runs out if it is not renewed once more: not before the one, not after the other.
    Timestamp lasts_until{0};
    Timestamp over_by{0};
    std::size_t renewals_under_way = 0;
    Tick may_end_from = never;
    Tick ended_by = never;
  };

  /// The first moment that was not before that time.
  Tick first_tick_at(Timestamp time) const;
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
  Tick tick_ = 0;
  std::vector<std::pair<Timestamp, Tick>> advances_;
  std::vector<Operation> operations_;
  /// By entry and token.
  std::map<std::pair<std::uint32_t, Token>, Lease> leases_;
  std::map<Client, Tick> deaths_;
  std::map<Client, Tick> may_be_lost_;
  /// Of working memories that kept their entries.
  std::vector<Restart> restarts_;
  std::vector<Jump> jumps_;
};

} // namespace castor::linearizability
