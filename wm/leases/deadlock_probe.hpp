#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace castor {

/// One component's wait for another.
struct WaitEdge {
  enum class Kind : std::uint8_t {
    /// For the lease of the entry.
    lock,
    /// To read the entry, which is leased at level ODR.
    read,
    /// For the owner of the ephemeral entry to do something.
    owner,
  };

  Kind kind = Kind::lock;
  ClientPtr waiter;
  /// The waiter's number for it.
  WaitNumber number = 0;
  /// When it began.
  Timestamp since{0};
  /// What it is for; for the read of a whole working memory the id is filled in there.
  Address address;
  /// What the waiter calls it: "waits to lock a/1".
  std::string what;
  /// What stood in the way when the probe passed: a lease's token, or the version of the entry
  /// whose owner is waited for.
  std::uint64_t obstacle = 0;

  /// Whether it is the same wait for the same thing.
  friend bool operator==(const WaitEdge& a, const WaitEdge& b) {
    return *a.waiter == *b.waiter && a.number == b.number && a.obstacle == b.obstacle;
  }
};

/// Looks for a cycle of waits by going along it: from a waiting component to the working memory
/// that knows what stands in its way, from there to the component that could clear it, on to what
/// that one waits for, and so forth. Whoever gets its own probe back waits for itself, if every
/// wait on the way still stands: so the probe goes round a second time, and only if it meets the
/// same waits again is there a deadlock. (Chandy, Misra and Haas: Distributed deadlock detection,
/// 1983.)
struct DeadlockProbe {
  /// The last edge is the one to be followed.
  std::vector<WaitEdge> path;
  /// The length of the path after the first round; 0 during it.
  std::size_t round = 0;
};

/// What a component makes of a probe that reaches it while it waits itself.
enum class ProbeVerdict : std::uint8_t {
  /// Nothing: it is no cycle, or not this one's business.
  drop,
  /// The probe, with the component's own wait added, goes on.
  pass_on,
  /// The component's wait is the youngest of a cycle: it has to fail.
  deadlock,
};

/// A probe that reaches a component that waits as `own` says.
ProbeVerdict receive_probe(DeadlockProbe& probe, const WaitEdge& own);

/// "a waits to lock x/1, b waits to lock x/2, which a holds", of a probe whose verdict is deadlock.
std::string cycle_of(const DeadlockProbe& probe);

} // namespace castor
