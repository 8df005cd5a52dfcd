#include "castor/planning/symbolic/lazy_search.hpp"

#include "castor/planning/symbolic/state_registry.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <utility>

namespace castor::planning {

namespace {

constexpr std::uint32_t no_state = std::numeric_limits<std::uint32_t>::max();

/// Turns that the queues of preferred operators get for each progress (Richter and Helmert 2009).
constexpr int boost = 1000;

/// Expansions between two reports to the observer.
constexpr std::size_t report_interval = 2048;

/// States have numbers of 32 bits.
constexpr std::size_t most_expanded_ever = std::size_t{1} << 32;

/// A state that is not made yet.
struct OpenEntry {
  std::uint32_t parent = no_state;
  int operator_index = -1;
};

/// Entries in ascending order of keys, those of the same key in the order that they came.
class OpenList {
public:
  void push(std::int64_t key, const OpenEntry& entry) {
    buckets_[key].push_back(entry);
    ++size_;
  }

  OpenEntry pop() {
    auto first = buckets_.begin();
    const auto result = first->second.front();
    first->second.pop_front();
    if (first->second.empty())
      buckets_.erase(first);
    --size_;
    return result;
  }

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }

  int priority = 0;

private:
  std::map<std::int64_t, std::deque<OpenEntry>> buckets_;
  std::size_t size_ = 0;
};

/// How a state was reached.
struct StateInfo {
  std::uint32_t parent = no_state;
  int operator_index = -1;
  /// Real cost, and the cost that the search counts.
  std::int64_t cost = 0;
  std::int64_t counted = 0;
  bool is_dead_end = false;
};

class LazySearch {
public:
  LazySearch(const Task& task, const SuccessorGenerator& successors, const LandmarkCount& landmarks,
             const SearchOptions& options, LimitWatch& watch, SearchCounts& counts,
             const SearchObserver& observer)
    : task_(task), successors_(successors), landmarks_(landmarks), options_(options), watch_(watch),
      counts_(counts), observer_(observer), relaxed_plan_(task, options.cost_count),
      registry_(task), reached_(std::max<std::size_t>(landmarks.words(), 1)),
      has_landmarks_(options.has_landmarks && landmarks.size() > 0) {
    best_.fill(dead_end);
  }

  SearchResult run() {
    if (options_.bound <= 0)
      return {{}, true};
    state_ = task_.initial;
    registry_.add(state_);
    infos_.emplace_back();
    if (has_landmarks_) {
      landmarks_.begin(state_, reached_.data());
      store_reached(0);
    }
    const auto last = counts_.expanded + std::min(options_.most_expanded, most_expanded_ever);
    if (auto plan = expand(0))
      return {std::move(plan), false};
    while (auto* list = next_list()) {
      if (counts_.expanded >= last)
        return {};
      const auto entry = list->pop();
      ++list->priority;
      if (const auto state = make_state(entry); state != no_state)
        if (auto plan = expand(state))
          return {std::move(plan), false};
      // An evaluation looks at all operators in the worst case.
      watch_.check(64 + task_.operators.size() / 16);
    }
    return {{}, true};
  }

private:
  enum Queue : std::size_t { by_plan, by_plan_preferred, by_landmarks, by_landmarks_preferred };

  OpenList* next_list() {
    OpenList* result = nullptr;
    for (auto& x : lists_)
      if (!x.empty() && (!result || x.priority < result->priority))
        result = &x;
    return result;
  }

  std::uint64_t* stored_reached(std::uint32_t state) {
    return &all_reached_[state * landmarks_.words()];
  }

  void store_reached(std::uint32_t state) {
    if (!has_landmarks_)
      return;
    const auto end = (static_cast<std::size_t>(state) + 1) * landmarks_.words();
    if (all_reached_.size() < end)
      all_reached_.resize(end);
    std::copy_n(reached_.data(), landmarks_.words(), stored_reached(state));
  }

  /// Number of the state that the entry leads to, if it is to be expanded. It is in `state_`.
  std::uint32_t make_state(const OpenEntry& entry) {
    const auto parent = infos_[entry.parent];
    const auto& op = task_.operators[static_cast<std::size_t>(entry.operator_index)];
    const auto cost = parent.cost + op.cost;
    if (cost >= options_.bound)
      return no_state;
    const auto counted = parent.counted + counted_cost(op, options_.cost_count);
    registry_.get(entry.parent, parent_state_);
    apply(task_, op, parent_state_, state_);
    const auto [number, is_new] = registry_.add(state_);
    ++counts_.generated;
    const StateInfo info{entry.parent, entry.operator_index, cost, counted, false};
    if (is_new) {
      infos_.push_back(info);
      if (has_landmarks_) {
        std::copy_n(stored_reached(entry.parent), landmarks_.words(), reached_.data());
        landmarks_.progress(state_, reached_.data());
        store_reached(number);
      }
      check_memory();
      return number;
    }
    auto& known = infos_[number];
    // Where the bound counts, a cheaper way may lead further than the first did.
    const bool is_cheaper = cost < known.cost || (options_.weight && counted < known.counted);
    if (known.is_dead_end || !is_cheaper || cost > known.cost)
      return no_state;
    if (!options_.weight && options_.bound == no_bound)
      return no_state;
    known = info;
    return number;
  }

  void check_memory() {
    if (infos_.size() % 256 != 0)
      return;
    std::size_t bytes = registry_.bytes() + infos_.capacity() * sizeof(StateInfo) +
                        all_reached_.capacity() * sizeof(std::uint64_t);
    for (const auto& x : lists_)
      bytes += x.size() * sizeof(OpenEntry);
    // Tables are twice as large while they grow.
    watch_.check_memory(bytes + bytes / 2);
  }

  std::optional<OperatorSequence> expand(std::uint32_t number) {
    if (holds(task_.goal, state_))
      return plan_to(number);
    preferred_.clear();
    ++counts_.evaluated;
    const int plan_estimate = relaxed_plan_.evaluate(state_, preferred_);
    if (plan_estimate == dead_end) {
      infos_[number].is_dead_end = true;
      return {};
    }
    ++counts_.expanded;
    if (observer_ && counts_.expanded % report_interval == 0)
      observer_(counts_);
    int landmark_estimate = 0;
    if (has_landmarks_) {
      std::copy_n(stored_reached(number), landmarks_.words(), reached_.data());
      landmark_estimate = landmarks_.evaluate(state_, reached_.data());
    }
    const std::array<int, 2> estimates{plan_estimate, landmark_estimate};
    bool is_progress = false;
    for (std::size_t i = 0; i < (has_landmarks_ ? 2U : 1U); ++i)
      if (estimates[i] < best_[i]) {
        best_[i] = estimates[i];
        is_progress = true;
      }
    if (is_progress) {
      lists_[by_plan_preferred].priority -= boost;
      lists_[by_landmarks_preferred].priority -= boost;
    }
    push_successors(number, estimates);
    return {};
  }

  void push_successors(std::uint32_t number, const std::array<int, 2>& estimates) {
    applicable_.clear();
    successors_.applicable(state_, applicable_);
    std::ranges::sort(preferred_);
    const auto& info = infos_[number];
    for (const int x : applicable_) {
      const auto& op = task_.operators[static_cast<std::size_t>(x)];
      if (info.cost + op.cost >= options_.bound)
        continue;
      const bool is_preferred =
        std::ranges::binary_search(preferred_, x) ||
        (has_landmarks_ && landmarks_.is_preferred(op, state_, reached_.data()));
      for (std::size_t i = 0; i < (has_landmarks_ ? 2U : 1U); ++i) {
        const std::int64_t key = options_.weight
                                   ? info.counted + std::int64_t{*options_.weight} * estimates[i]
                                   : estimates[i];
        lists_[2 * i].push(key, {number, x});
        if (is_preferred)
          lists_[2 * i + 1].push(key, {number, x});
      }
    }
  }

  OperatorSequence plan_to(std::uint32_t number) const {
    OperatorSequence result;
    for (; infos_[number].parent != no_state; number = infos_[number].parent)
      result.push_back(infos_[number].operator_index);
    std::ranges::reverse(result);
    return result;
  }

  const Task& task_;
  const SuccessorGenerator& successors_;
  const LandmarkCount& landmarks_;
  SearchOptions options_;
  LimitWatch& watch_;
  SearchCounts& counts_;
  const SearchObserver& observer_;
  RelaxedPlanHeuristic relaxed_plan_;
  StateRegistry registry_;
  std::vector<StateInfo> infos_;
  /// Landmarks reached, by state.
  std::vector<std::uint64_t> all_reached_;
  /// Of the state that is looked at.
  std::vector<std::uint64_t> reached_;
  bool has_landmarks_;
  std::array<OpenList, 4> lists_;
  std::array<int, 2> best_{};
  State state_;
  State parent_state_;
  std::vector<int> preferred_;
  std::vector<int> applicable_;
};

} // namespace

SearchResult search_lazily(const Task& task, const SuccessorGenerator& successors,
                           const LandmarkCount& landmarks, const SearchOptions& options,
                           LimitWatch& watch, SearchCounts& counts,
                           const SearchObserver& observer) {
  return LazySearch(task, successors, landmarks, options, watch, counts, observer).run();
}

} // namespace castor::planning
