#pragma once

#include "castor/tools/linearizability/history.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace castor::linearizability {

/// What a simulated client believes of an entry.
struct EntryView {
  std::optional<Version> seen;
  bool present = false;
  /// In hand, and obtained so often.
  Token token = 0;
  std::size_t times = 0;
  /// A lock was never answered: it may have obtained the lease once more than it knows.
  bool unsure = false;
  /// Of leases it had.
  std::vector<Token> old_tokens;
  /// Of these, those that were given back.
  std::vector<Token> returned_tokens;

  /// Its lease is not in hand any more.
  void lose_lease() {
    if (token != 0)
      old_tokens.push_back(token);
    token = 0;
    times = 0;
  }
};

} // namespace castor::linearizability
