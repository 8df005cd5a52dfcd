#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Whether what clients saw of the entries of a working memory can be explained by one operation
/// happening after the other, each at some moment between its invocation and its return.
namespace castor::linearizability {

/// A moment, as a count of one monotonic counter.
using Tick = std::uint64_t;
inline constexpr Tick never = UINT64_MAX;

/// A component in one incarnation: who comes back after a crash is another client.
using Client = std::uint32_t;
using Version = std::uint64_t;
/// Stands for a value; a history is the sharper the fewer writes share one.
using Content = std::uint64_t;
/// 0 is no token.
using Token = std::uint64_t;

enum class OperationKind : std::uint8_t {
  add,
  overwrite,
  remove,
  read,
  exists,
  version,
  lock,
  try_lock,
  unlock,
  /// No operation of a client: what is known about the end of a lease by expiry or by the death of
  /// its holder. `client` is the holder, and `token` the lease's as a lock returned it, or 0 for
  /// whichever lease of the entry the client has. It ended at some moment from `invoked` to
  /// `returned` if it had not ended before; or it need not have ended at all, unless `mandatory`.
  lapse,
  /// No operation of a client either: the working memory ended, and another took its place, which
  /// need not know what has happened to the entry. Its result says what the new one begins with:
  /// the token that all of its own are above; and the entry's version and content if its status is
  /// ok, the version that it was deleted with for does_not_exist, and for never_existed the version
  /// that an addition gets.
  loss,
};

/// Whom a lease keeps from what: overwriting; deleting too; reading too.
enum class LockLevel : std::uint8_t { o = 1, od, odr };

enum class Status : std::uint8_t {
  ok,
  does_not_exist,
  already_exists,
  inconsistent,
  /// A write without a token to an entry that is leased.
  locked,
  /// A token that is not that of the client's current lease of the entry.
  stale,
  busy,
  never_existed,
  /// Given up while it waited. One that may have been granted when its client gave up is to be
  /// recorded as pending, with a `lapse` of token 0.
  timed_out,
};

/// What an operation gave; what it does not give stays 0.
struct Result {
  Status status = Status::ok;
  /// The version written or read; of a deletion, the last one.
  Version version = 0;
  /// Of a read.
  Content content = 0;
  /// Of a lock.
  Token token = 0;

  bool operator==(const Result&) const = default;
};

/// One operation on one entry.
struct OperationRecord {
  Client client = 0;
  std::uint32_t entry = 0;
  OperationKind kind = OperationKind::read;

  /// Written by an add or overwrite.
  Content content = 0;
  /// For an overwrite: the version that the client last read or wrote.
  std::optional<Version> last_seen;
  /// Asked for by a lock.
  LockLevel level = LockLevel::o;
  /// Shown by an overwrite, deletion or unlock; 0 if none was.
  Token token = 0;
  /// For a lapse.
  bool mandatory = false;

  /// Means nothing while the operation is pending.
  Result result;

  Tick invoked = 0;
  /// `never` while it is pending: then it may have happened or not.
  Tick returned = never;
  /// For a lock or read: when the working memory is known to have had the request, which by then
  /// was answered or stood in the queue. Means nothing while the operation is pending.
  Tick queued_by = never;

  bool pending() const { return returned == never; }

  /// Whether it need not have happened.
  bool may_be_left_out() const { return pending() || (kind == OperationKind::lapse && !mandatory); }

  bool may_wait() const { return kind == OperationKind::lock || kind == OperationKind::read; }

  /// When it had reached the working memory at the latest.
  Tick arrived_by() const {
    return may_wait() && !pending() && queued_by < returned ? queued_by : returned;
  }
};

using History = std::vector<OperationRecord>;

std::string to_string(OperationKind x);
std::string to_string(LockLevel x);
std::string to_string(Status x);
/// As an operation of that kind would print it.
std::string to_string(OperationKind kind, const Result& x);
/// One line.
std::string to_string(const OperationRecord& x);

} // namespace castor::linearizability
