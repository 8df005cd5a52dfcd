#pragma once

#include "castor/planning/symbolic/landmarks.hpp"
#include "castor/planning/symbolic/limits.hpp"
#include "castor/planning/symbolic/relaxed_plan_heuristic.hpp"
#include "castor/planning/symbolic/successor_generator.hpp"
#include "castor/planning/symbolic/task.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace castor::planning {

inline constexpr std::int64_t no_bound = std::numeric_limits<std::int64_t>::max();

struct SearchOptions {
  CostCount cost_count = CostCount::one;
  /// Of the estimate in weighted A*; nothing for greedy best-first search.
  std::optional<int> weight;
  /// Plans must cost less than this.
  std::int64_t bound = no_bound;
  bool has_landmarks = true;
  /// Ends without a result after so many states.
  std::size_t most_expanded = std::numeric_limits<std::size_t>::max();
};

struct SearchCounts {
  std::size_t expanded = 0;
  std::size_t evaluated = 0;
  std::size_t generated = 0;
};

/// Indices of operators.
using OperatorSequence = std::vector<int>;

struct SearchResult {
  std::optional<OperatorSequence> plan;
  /// There is no plan that costs less than the bound.
  bool is_exhausted = false;
};

/// Called now and then.
using SearchObserver = std::function<void(const SearchCounts&)>;

/// Best-first search with deferred evaluation: a state is evaluated when it is expanded, and waits
/// in queues with the estimates of its parent (Richter and Helmert 2009). Queues by h_FF and by
/// landmarks take turns; those of preferred operators are boosted after each progress (Helmert
/// 2006).
/// \throws LimitError
SearchResult search_lazily(const Task& task, const SuccessorGenerator& successors,
                           const LandmarkCount& landmarks, const SearchOptions& options,
                           LimitWatch& watch, SearchCounts& counts, const SearchObserver& observer);

} // namespace castor::planning
