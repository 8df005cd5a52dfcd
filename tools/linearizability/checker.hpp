#pragma once

#include "castor/tools/linearizability/entry_search.hpp"
#include "castor/tools/linearizability/history.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace castor::linearizability {

struct Verdict {
  enum class Kind : std::uint8_t {
    ok,
    /// No order of the operations explains what was observed.
    violation,
    /// The search was given up before it came to an end.
    undecided,
  };

  Kind kind = Kind::ok;
  /// Lines of text, empty if the history is linearizable: the entry, the longest order found, the
  /// operations that could not follow it, and why.
  std::string report;

  bool ok() const { return kind == Kind::ok; }
};

struct CheckerOptions {
  /// Limit of states that the search of one entry may try. A hundred operations need about as many;
  /// only histories with many indistinguishable waits need more than thousands.
  std::uint64_t max_states = 1'000'000;
};

/// Checks whether a history is linearizable: entry by entry, which is sufficient (Herlihy and Wing,
/// "Linearizability: a correctness condition for concurrent objects", 1990, theorem 1).
///
/// Reuse one for many histories, since it keeps its allocated memory. Each thread needs its own.
class Checker {
public:
  explicit Checker(CheckerOptions options = {}) : options_(options) {}

  /// The records may be in any order; every entry starts as never existed. A violation of one entry
  /// outweighs undecided others. Throws std::invalid_argument if a record ends before it begins.
  Verdict check(std::span<const OperationRecord> history);

  /// Number of states that the last check tried.
  std::uint64_t states() const { return states_; }

private:
  Verdict check_entry(std::span<const OperationRecord> operations);

  CheckerOptions options_;
  EntrySearch search_;
  History sorted_;
  std::uint64_t states_ = 0;
};

} // namespace castor::linearizability
