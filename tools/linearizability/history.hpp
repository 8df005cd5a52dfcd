#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Linearizability of working memories: whether the results of all operations can be explained by a
/// sequence of the operations in which each happens between its invocation and its return.
namespace castor::linearizability {

/// Logical time: value of one monotonic counter.
using Tick = std::uint64_t;
inline constexpr Tick never = UINT64_MAX;

/// A component in one incarnation: after a restart it is another client.
using Client = std::uint32_t;
using Version = std::uint64_t;
/// Identifies a value. The fewer writes share one, the more errors a history can reveal.
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
  /// Not a client's operation: the end of a lease by expiry or by the end of its holder. `client`
  /// is the holder, `token` that of the lease, or 0 for any lease of the entry held by the client.
  /// The lease ended between `invoked` and `returned` if it had not ended before. Unless
  /// `mandatory`, it may also have lasted.
  lapse,
  /// Not a client's operation: the working memory ended and was replaced by one that may lack
  /// changes of the entry. Its result is the initial state of the replacement: a lower bound of its
  /// tokens; and for status ok the entry's version and content, for does_not_exist the version that
  /// it was deleted with, for never_existed the version that an addition gets.
  loss,
};

/// Operations that a lease forbids to others: overwriting; also deleting; also reading.
enum class LockLevel : std::uint8_t { o = 1, od, odr };

enum class Status : std::uint8_t {
  ok,
  does_not_exist,
  already_exists,
  inconsistent,
  /// A write without a token to a leased entry.
  locked,
  /// A token that is not that of the client's current lease of the entry.
  stale,
  busy,
  never_existed,
  /// Given up while waiting. An operation that may have been granted when its client gave up must
  /// be recorded as pending, with a `lapse` of token 0.
  timed_out,
};

/// Result of an operation; fields that it does not return are 0.
struct Result {
  Status status = Status::ok;
  /// The version written or read; for a deletion, the last one.
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

  /// For an add or overwrite: the value written.
  Content content = 0;
  /// For an overwrite: the version that the client last read or wrote.
  std::optional<Version> last_seen;
  /// For a lock: the level requested.
  LockLevel level = LockLevel::o;
  /// For an overwrite, deletion or unlock: the token shown; 0 for none.
  Token token = 0;
  /// For a lapse.
  bool mandatory = false;

  /// Undefined while the operation is pending.
  Result result;

  Tick invoked = 0;
  /// `never` while pending: then it may have happened or not.
  Tick returned = never;
  /// For a lock or read: time by which the working memory had received the request and answered or
  /// queued it. Undefined while the operation is pending.
  Tick queued_by = never;

  bool pending() const { return returned == never; }

  /// Whether it may not have happened.
  bool may_be_left_out() const { return pending() || (kind == OperationKind::lapse && !mandatory); }

  bool locks() const { return kind == OperationKind::lock || kind == OperationKind::try_lock; }

  bool may_wait() const { return kind == OperationKind::lock || kind == OperationKind::read; }

  /// Latest time at which it reached the working memory.
  Tick arrived_by() const {
    return may_wait() && !pending() && queued_by < returned ? queued_by : returned;
  }
};

using History = std::vector<OperationRecord>;

std::string to_string(OperationKind x);
std::string to_string(LockLevel x);
std::string to_string(Status x);
/// The result as it is printed for that kind of operation.
std::string to_string(OperationKind kind, const Result& x);
/// One line.
std::string to_string(const OperationRecord& x);

} // namespace castor::linearizability
