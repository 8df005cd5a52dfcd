#pragma once

#include "castor/tools/linearizability/history.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace castor::linearizability {

/// An operation's place in the list of the operations on its entry.
using OperationIndex = std::uint32_t;

/// How an entry stands between two operations.
struct EntryState {
  enum class Presence : std::uint8_t { unheard_of, present, deleted };

  static constexpr std::size_t max_waiting = 32;

  Presence presence = Presence::unheard_of;
  /// Whether anybody knows the lease's token: the operation that obtained it may be pending.
  bool token_known = false;
  std::uint16_t waiting = 0;
  Client holder = 0;
  /// The last version, of a deleted entry too; of one unheard of, that of an addition.
  Version version = 0;
  Content content = 0;
  /// The lease's levels, two bits each, the one to be given back first in the lowest bits; 0 if
  /// there is no lease.
  std::uint64_t levels = 0;
  /// Of the lease.
  Token token = 0;
  /// The highest that was granted.
  Token last_token = 0;
  /// The operations that wait, first come, first served; valid up to `waiting`.
  std::array<OperationIndex, max_waiting> queue{};

  bool present() const { return presence == Presence::present; }
  bool leased() const { return levels != 0; }
  bool leased_by(Client client) const { return leased() && holder == client; }
  /// Whether the token is good; one that nobody was told is known to no one who shows a token.
  bool leased_under(Token shown, Client client) const {
    return leased_by(client) && token_known && token == shown;
  }
  /// The strongest of the lease's levels.
  LockLevel level() const;
};

/// An operation that had to wait, and what came of it.
struct SettledWait {
  OperationIndex operation;
  Result result;
};

/// What a working memory promises for one entry, one operation at a time.
///
/// Of several failures that apply the first of these is reported: does not exist (or already
/// exists), stale, locked, inconsistent. A write that shows no token counts as one by somebody
/// without a lease, also if its client holds one. The version check is made under a lease too.
///
/// Locking again by the holder obtains the same token and must be given back as often; given back
/// is always what was obtained last. Tokens are the working memory's choice as long as they rise:
/// a lock obtains the token that its record shows, if that can be, and else the next.
///
/// A lock of a leased entry and a read of one that somebody else leased at level ODR wait in one
/// queue. When a lease ends, the queue is served from its front: reads, up to the first lock,
/// which obtains the lease; and from then on only reads: all if the new level allows reading, else
/// those of the new holder. When a lease is weakened to a level that allows reading, all reads in
/// the queue are served. A deletion ends the lease and fails all that wait; after a loss, nobody
/// who waits is answered.
class EntryModel {
public:
  explicit EntryModel(std::span<const OperationRecord> operations) : operations_(operations) {}

  /// What an operation that arrives now is answered; nothing if it has to wait.
  std::optional<Result> answer(const EntryState& state, OperationIndex operation) const;

  /// Performs it, and adds those whose wait ends by it to `settled`. Throws std::length_error if
  /// more wait, or leases are nested deeper, than a state has room for.
  std::optional<Result> arrive(EntryState& state, OperationIndex operation,
                               std::vector<SettledWait>& settled) const;

  /// Takes an operation that waits out of the queue.
  void give_up(EntryState& state, OperationIndex operation) const;

  /// Whether a lapse would end the lease.
  bool ends_lease(const EntryState& state, const OperationRecord& lapse) const;

private:
  std::optional<Result> answer_lock(const EntryState& state, const OperationRecord& lock) const;
  /// What stands against a write, other than the version.
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
