#pragma once

#include "castor/tools/linearizability/history.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace castor::linearizability {

/// A simulated client's knowledge of an entry.
struct EntryView {
  std::optional<Version> seen;
  bool present = false;
  /// Token of its current lease, 0 for none, and how often the lease was obtained.
  Token token = 0;
  std::size_t times = 0;
  /// A lock was never answered: the lease may have been obtained once more than `times`.
  bool unsure = false;
  /// Tokens of former leases.
  std::vector<Token> old_tokens;
  /// Those of them that were unlocked.
  std::vector<Token> returned_tokens;

  /// The client no longer holds its lease.
  void lose_lease() {
    if (token != 0)
      old_tokens.push_back(token);
    token = 0;
    times = 0;
  }
};

} // namespace castor::linearizability
