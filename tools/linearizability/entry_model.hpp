#pragma once

#include "castor/tools/linearizability/history.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace castor::linearizability {

/// An operation's index in the list of the operations on its entry.
using OperationIndex = std::uint32_t;

/// State of an entry between two operations.
struct EntryState {
  enum class Presence : std::uint8_t { never_existed, present, deleted };

  static constexpr std::size_t max_waiting = 32;

  Presence presence = Presence::never_existed;
  /// Whether the lease's token was returned to its client: the operation that obtained it may be
  /// pending.
  bool token_known = false;
  std::uint16_t waiting = 0;
  Client holder = 0;
  /// The last version, also of a deleted entry; for an entry that never existed, the version that
  /// an addition gets.
  Version version = 0;
  Content content = 0;
  /// The lease's nested levels, two bits each, the innermost in the lowest bits; 0 if there is no
  /// lease.
  std::uint64_t levels = 0;
  /// Token of the lease.
  Token token = 0;
  /// Highest token that was granted.
  Token last_token = 0;
  /// FIFO queue of waiting operations; valid up to `waiting`.
  std::array<OperationIndex, max_waiting> queue{};

  bool present() const { return presence == Presence::present; }
  bool leased() const { return levels != 0; }
  bool leased_by(Client client) const { return leased() && holder == client; }
  /// Whether the client holds the lease with this token. A token that was never returned cannot be
  /// shown.
  bool leased_under(Token shown, Client client) const {
    return leased_by(client) && token_known && token == shown;
  }
  /// Strongest of the lease's levels.
  LockLevel level() const;
};

/// A waiting operation and its result.
struct SettledWait {
  OperationIndex operation;
  Result result;
};

/// Sequential specification of one entry of a working memory.
///
/// If several failures apply, the first of these is reported: does not exist (or already exists),
/// stale, locked, inconsistent. A write without a token is treated as one by a client without a
/// lease, even if its client holds one. The version check is made under a lease too.
///
/// A nested lock by the holder obtains the same token and needs its own unlock; an unlock releases
/// the level obtained last. The working memory may choose any increasing tokens: a lock obtains the
/// token in its record if that is possible, otherwise the next one.
///
/// A lock of a leased entry and a read of an entry that another client leased at level ODR wait in
/// one queue. When a lease ends, the queue is served from its front: reads, up to the first lock,
/// which obtains the lease; after that only reads: all if the new level allows reading, otherwise
/// those of the new holder. When a lease is weakened to a level that allows reading, all reads in
/// the queue are served. A deletion ends the lease and fails all waiting operations; after a loss,
/// waiting operations are never answered.
class EntryModel {
public:
  explicit EntryModel(std::span<const OperationRecord> operations) : operations_(operations) {}

  /// Result of an operation that arrives now; nothing if it has to wait.
  std::optional<Result> answer(const EntryState& state, OperationIndex operation) const;

  /// Performs the operation and adds the operations whose wait it ends to `settled`. Throws
  /// std::length_error if more operations wait, or leases are nested deeper, than a state can
  /// store.
  std::optional<Result> arrive(EntryState& state, OperationIndex operation,
                               std::vector<SettledWait>& settled) const;

  /// Removes a waiting operation from the queue.
  void give_up(EntryState& state, OperationIndex operation) const;

  /// Whether a lapse would end the lease.
  bool ends_lease(const EntryState& state, const OperationRecord& lapse) const;

private:
  std::optional<Result> answer_lock(const EntryState& state, const OperationRecord& lock) const;
  /// Reason to refuse a write, other than its version; nothing if there is none.
  std::optional<Result> refusal(const EntryState& state, const OperationRecord& write) const;
  Result answer_read(const EntryState& state) const;
  void obtain(EntryState& state, const OperationRecord& lock, Token token) const;
  void give_back(EntryState& state, std::vector<SettledWait>& settled) const;
  void end_lease(EntryState& state, std::vector<SettledWait>& settled) const;
  void remove(EntryState& state, std::vector<SettledWait>& settled) const;
  void lose(EntryState& state, const OperationRecord& loss,
            std::vector<SettledWait>& settled) const;
  void serve_reads(EntryState& state, std::vector<SettledWait>& settled) const;

  std::span<const OperationRecord> operations_;
};

} // namespace castor::linearizability
