#pragma once

#include "castor/tools/linearizability/history.hpp"

#include <cstddef>
#include <cstdint>
#include <random>

/// Histories that follow from a seed.
namespace castor::linearizability {

using Random = std::mt19937_64;

struct RandomHistoryOptions {
  std::size_t clients = 6;
  std::size_t entries = 3;
  std::size_t operations = 100;
  /// Ticks by which an operation may begin before, or return after, what it did happened. Ten
  /// ticks lie between one operation and the next.
  Tick width = 60;
  /// Chances in a hundred, at every operation.
  unsigned deaths = 1;
  unsigned lapses = 3;
  unsigned time_outs = 3;
  /// That a client does not wait for the answer to its last operation.
  unsigned overlaps = 0;
};

/// A linearizable history: what clients would have seen of the model, and know of its lapses.
History random_history(const RandomHistoryOptions& options, Random& random);

/// Changes one result or the moment of one operation; the history may be linearizable still.
void falsify(History& history, Random& random);

} // namespace castor::linearizability
