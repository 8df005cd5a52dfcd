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
    /// Waits for the lease of the entry.
    lock,
    /// Waits to read the entry, which is leased at level ODR.
    read,
    /// Waits for the owner of the ephemeral entry, for instance to serve a call.
    owner,
  };

  Kind kind = Kind::lock;
  ClientPtr waiter;
  /// Number that the waiter gave to the operation.
  WaitNumber number = 0;
  /// Begin of the wait.
  Timestamp since{0};
  /// Entry waited for. For a query of a whole working memory, that working memory fills in the id.
  Address address;
  /// Description for messages: "waits to lock a/1".
  std::string what;
  /// Obstacle when the probe passed: the token of the lease, or the version of the entry whose
  /// owner is waited for.
  std::uint64_t obstacle = 0;

  /// Whether it is the same wait for the same obstacle.
  friend bool operator==(const WaitEdge& a, const WaitEdge& b) {
    return *a.waiter == *b.waiter && a.number == b.number && a.obstacle == b.obstacle;
  }
};

/// Detects a cycle of waits by edge chasing: it is sent from a waiting component to the working
/// memory of the entry, from there to the component that holds the lease or owns the entry, on to
/// the entry that this one waits for, and so forth. A component that receives its own probe is part
/// of a wait cycle, if every wait on the path still exists: so the probe goes round a second time,
/// and only if it finds the same waits again is there a deadlock. (Chandy, Misra and Haas:
/// Distributed deadlock detection, 1983.)
struct DeadlockProbe {
  /// The last edge is the next one to follow.
  std::vector<WaitEdge> path;
  /// The length of the path after the first round; 0 during it.
  std::size_t round = 0;
};

/// Reaction of a waiting component to a probe.
enum class ProbeVerdict : std::uint8_t {
  /// Drop the probe: there is no cycle, or this component does not close it.
  drop,
  /// Forward the probe, with the component's own wait added.
  pass_on,
  /// The component's wait is the youngest of a cycle: it has to fail.
  deadlock,
};

/// Handles a probe at a component whose wait is `own`.
ProbeVerdict receive_probe(DeadlockProbe& probe, const WaitEdge& own);

/// Text of the cycle of a probe whose verdict is deadlock: "a waits to lock x/1, b waits to lock
/// x/2, which a holds".
std::string cycle_of(const DeadlockProbe& probe);

} // namespace castor
