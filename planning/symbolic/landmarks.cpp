#include "castor/planning/symbolic/landmarks.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <map>
#include <utility>

namespace castor::planning {

namespace {

using Facts = std::vector<std::uint32_t>;

/// Facts of one disjunctive landmark at most (Richter and Westphal 2010).
constexpr std::size_t most_alternatives = 4;

/// Sum of the sizes of all sets of landmarks, beyond which there are none.
constexpr std::size_t most_set_elements = 30'000'000;

bool contains(const Facts& facts, std::uint32_t x) {
  return std::ranges::binary_search(facts, x);
}

class LandmarkFinder {
public:
  LandmarkFinder(const Task& task, LimitWatch& watch)
    : task_(task), watch_(watch), sets_(task.fact_count()), is_reached_(task.fact_count(), false),
      achievers_(task.fact_count()), is_initial_(task.fact_count(), false) {
    for (const auto& op : task.operators)
      for (const auto& effect : op.effects) {
        watch_.check();
        auto condition = op.precondition;
        condition.insert(condition.end(), effect.condition.begin(), effect.condition.end());
        add_rule(condition, effect.fact);
      }
    for (const auto& x : task.axioms)
      add_rule(x.body, {x.variable, 1});
    for (std::size_t i = 0; i < task.initial.size(); ++i) {
      is_initial_[task.first_facts[i] + static_cast<std::size_t>(task.initial[i])] = true;
      if (task.is_derived[i])
        is_initial_[task.first_facts[i]] = true;
    }
  }

  std::vector<Landmark> run() {
    if (!find_sets())
      return {};
    for (const auto& x : task_.goal) {
      const auto goal = index(x);
      if (!is_reached_[goal])
        return {};
      for (const auto fact : sets_[goal])
        landmarks_[landmark_of({fact})].is_goal |= fact == goal;
    }
    // Alternatives are found on the way back from those that are known, which may be more then.
    for (std::uint32_t i = 0; i < landmarks_.size(); ++i)
      look_back(i);
    add_natural_orders();
    add_reasonable_orders();
    for (auto& x : landmarks_) {
      sort_unique(x.before);
      sort_unique(x.directly_after);
    }
    return std::move(landmarks_);
  }

private:
  struct Rule {
    Facts condition;
    std::uint32_t effect = 0;
  };

  std::uint32_t index(const Fact& x) const {
    return static_cast<std::uint32_t>(task_.fact_index(x));
  }

  static void sort_unique(Facts& x) {
    std::ranges::sort(x);
    x.erase(std::unique(x.begin(), x.end()), x.end());
  }

  void add_rule(const std::vector<Fact>& condition, const Fact& effect) {
    Rule rule;
    for (const auto& x : condition)
      rule.condition.push_back(index(x));
    sort_unique(rule.condition);
    rule.effect = index(effect);
    if (contains(rule.condition, rule.effect))
      return;
    achievers_[rule.effect].push_back(static_cast<std::uint32_t>(rules_.size()));
    rules_.push_back(std::move(rule));
  }

  /// Landmarks of all conditions of a rule.
  Facts set_of(const Rule& rule) const {
    Facts result;
    for (const auto x : rule.condition)
      result.insert(result.end(), sets_[x].begin(), sets_[x].end());
    sort_unique(result);
    return result;
  }

  /// The greatest fixpoint: a fact's landmarks are itself, and those that all its achievers have.
  bool find_sets() {
    std::vector<Facts> users(task_.fact_count());
    for (std::uint32_t i = 0; i < rules_.size(); ++i)
      for (const auto x : rules_[i].condition)
        users[x].push_back(i);
    std::deque<std::uint32_t> queue;
    std::vector<bool> is_queued(rules_.size(), false);
    const auto enqueue = [&](std::uint32_t rule) {
      if (!is_queued[rule])
        queue.push_back(rule);
      is_queued[rule] = true;
    };
    std::size_t elements = 0;
    for (std::uint32_t i = 0; i < is_initial_.size(); ++i)
      if (is_initial_[i]) {
        is_reached_[i] = true;
        sets_[i] = {i};
      }
    for (std::uint32_t i = 0; i < rules_.size(); ++i)
      enqueue(i);
    while (!queue.empty()) {
      const auto& rule = rules_[queue.front()];
      is_queued[queue.front()] = false;
      queue.pop_front();
      if (is_initial_[rule.effect] ||
          !std::ranges::all_of(rule.condition, [&](auto x) { return is_reached_[x]; }))
        continue;
      auto set = set_of(rule);
      watch_.check(1 + set.size() / 64);
      if (!contains(set, rule.effect))
        set.insert(std::ranges::lower_bound(set, rule.effect), rule.effect);
      auto& known = sets_[rule.effect];
      if (is_reached_[rule.effect]) {
        Facts both;
        std::ranges::set_intersection(known, set, std::back_inserter(both));
        if (both.size() == known.size())
          continue;
        set = std::move(both);
      }
      elements += set.size() - known.size();
      if (known.empty() && elements > most_set_elements)
        return false;
      known = std::move(set);
      is_reached_[rule.effect] = true;
      for (const auto x : users[rule.effect])
        enqueue(x);
    }
    return true;
  }

  std::uint32_t landmark_of(const Facts& facts) {
    const auto [place, is_new] =
      numbers_.try_emplace(facts, static_cast<std::uint32_t>(landmarks_.size()));
    if (is_new) {
      landmarks_.push_back({facts, false, {}, {}});
      first_conditions_.emplace_back();
    }
    return place->second;
  }

  /// Rules that reach one of the facts without having had it before.
  std::vector<const Rule*> first_achievers(const Facts& facts) const {
    std::vector<const Rule*> result;
    for (const auto fact : facts)
      for (const auto i : achievers_[fact]) {
        const auto& rule = rules_[i];
        const auto is_before = [&](std::uint32_t x) {
          return !is_reached_[x] ||
                 std::ranges::any_of(facts, [&](auto y) { return contains(sets_[x], y); });
        };
        if (std::ranges::none_of(rule.condition, is_before))
          result.push_back(&rule);
      }
    return result;
  }

  /// What is true directly before the landmark is for the first time.
  void look_back(std::uint32_t number) {
    const auto facts = landmarks_[number].facts;
    if (std::ranges::any_of(facts, [&](auto x) { return is_initial_[x]; }))
      return;
    const auto rules = first_achievers(facts);
    if (rules.empty())
      return;
    Facts common = rules.front()->condition;
    for (const auto* rule : rules) {
      Facts both;
      std::ranges::set_intersection(common, rule->condition, std::back_inserter(both));
      common = std::move(both);
    }
    for (const auto x : common) {
      const auto earlier = landmark_of({x});
      landmarks_[number].before.push_back(earlier);
      landmarks_[earlier].directly_after.push_back(number);
      first_conditions_[number].push_back(x);
    }
    add_alternatives(number, rules);
  }

  /// A fact of the same predicate is needed by each first achiever.
  void add_alternatives(std::uint32_t number, const std::vector<const Rule*>& rules) {
    std::map<int, std::pair<std::size_t, Facts>> by_predicate;
    for (const auto* rule : rules) {
      std::map<int, Facts> own;
      for (const auto x : rule->condition)
        if (task_.fact_predicates[x] >= 0)
          own[task_.fact_predicates[x]].push_back(x);
      for (const auto& [predicate, facts] : own) {
        auto& [count, all] = by_predicate[predicate];
        ++count;
        if (all.size() <= most_alternatives) {
          all.insert(all.end(), facts.begin(), facts.end());
          sort_unique(all);
        }
      }
    }
    for (const auto& [predicate, found] : by_predicate) {
      const auto& [count, facts] = found;
      if (count < rules.size() || facts.size() < 2 || facts.size() > most_alternatives)
        continue;
      // Not if one of them is a landmark itself, or true already.
      if (std::ranges::any_of(
            facts, [&](auto x) { return is_initial_[x] || numbers_.contains(Facts{x}); }))
        continue;
      const auto earlier = landmark_of(facts);
      landmarks_[number].before.push_back(earlier);
      landmarks_[earlier].directly_after.push_back(number);
    }
  }

  void add_natural_orders() {
    for (const auto& [facts, number] : numbers_)
      if (facts.size() == 1)
        for (const auto x : sets_[facts.front()]) {
          const auto found = numbers_.find({x});
          if (x != facts.front() && found != numbers_.end())
            landmarks_[number].before.push_back(found->second);
        }
  }

  bool are_mutex(std::uint32_t a, std::uint32_t b) const {
    if (a == b)
      return false;
    for (const int x : task_.mutex_groups_of[a])
      if (std::ranges::find(task_.mutex_groups_of[b], x) != task_.mutex_groups_of[b].end())
        return true;
    return false;
  }

  /// Whether reaching `a` makes `b` false.
  bool interferes(std::uint32_t a, std::uint32_t b) const {
    const auto x = landmarks_[a].facts.front();
    const auto y = landmarks_[b].facts.front();
    return are_mutex(x, y) || std::ranges::any_of(first_conditions_[a], [&](auto z) {
             return z != y && are_mutex(z, y);
           });
  }

  bool is_before(std::uint32_t a, std::uint32_t b) const {
    return std::ranges::find(landmarks_[b].before, a) != landmarks_[b].before.end();
  }

  /// Of two goals, the one first that would make the other false.
  void add_reasonable_orders() {
    std::vector<std::uint32_t> goals;
    for (std::uint32_t i = 0; i < landmarks_.size(); ++i)
      if (landmarks_[i].is_goal)
        goals.push_back(i);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> orders;
    for (const auto a : goals)
      for (const auto b : goals)
        if (a != b && !is_before(b, a) && interferes(a, b) && !interferes(b, a))
          orders.emplace_back(a, b);
    for (const auto& [a, b] : orders)
      landmarks_[b].before.push_back(a);
    remove_cycles();
  }

  /// Orders that close a cycle are left out: nothing could come first.
  void remove_cycles() {
    std::vector<int> states(landmarks_.size(), 0);
    for (std::uint32_t start = 0; start < landmarks_.size(); ++start) {
      if (states[start] != 0)
        continue;
      std::vector<std::pair<std::uint32_t, std::size_t>> path{{start, 0}};
      states[start] = 1;
      while (!path.empty()) {
        auto& [number, next] = path.back();
        auto& before = landmarks_[number].before;
        if (next == before.size()) {
          states[number] = 2;
          path.pop_back();
        } else if (states[before[next]] == 1) {
          before.erase(before.begin() + static_cast<std::ptrdiff_t>(next));
        } else if (const auto x = before[next++]; states[x] == 0) {
          states[x] = 1;
          path.emplace_back(x, 0);
        }
      }
    }
  }

  const Task& task_;
  LimitWatch& watch_;
  std::vector<Rule> rules_;
  std::vector<Facts> sets_;
  std::vector<bool> is_reached_;
  std::vector<Facts> achievers_;
  std::vector<bool> is_initial_;
  std::vector<Landmark> landmarks_;
  std::map<Facts, std::uint32_t> numbers_;
  /// By landmark.
  std::vector<Facts> first_conditions_;
};

} // namespace

std::vector<Landmark> find_landmarks(const Task& task, LimitWatch& watch) {
  return LandmarkFinder(task, watch).run();
}

LandmarkCount::LandmarkCount(const Task& task, std::vector<Landmark> landmarks)
  : task_(task), landmarks_(std::move(landmarks)), of_fact_(task.fact_count()) {
  for (std::size_t i = 0; i < task.domain_sizes.size(); ++i)
    for (int value = 0; value < task.domain_sizes[i]; ++value)
      facts_.push_back({static_cast<int>(i), value});
  for (std::uint32_t i = 0; i < landmarks_.size(); ++i)
    for (const auto x : landmarks_[i].facts)
      of_fact_[x].push_back(i);
}

bool LandmarkCount::is_true(const Landmark& landmark, const State& state) const {
  return std::ranges::any_of(landmark.facts, [&](auto x) {
    return state[static_cast<std::size_t>(facts_[x].variable)] == facts_[x].value;
  });
}

bool LandmarkCount::is_next(std::size_t landmark, const std::uint64_t* reached) const {
  return std::ranges::all_of(landmarks_[landmark].before, [&](auto x) { return has(reached, x); });
}

void LandmarkCount::begin(const State& state, std::uint64_t* reached) const {
  std::fill_n(reached, words(), 0);
  for (std::size_t i = 0; i < landmarks_.size(); ++i)
    if (landmarks_[i].before.empty() && is_true(landmarks_[i], state))
      reached[i / 64] |= std::uint64_t{1} << (i % 64);
}

void LandmarkCount::progress(const State& state, std::uint64_t* reached) const {
  for (std::size_t i = 0; i < landmarks_.size(); ++i)
    if (!has(reached, i) && is_true(landmarks_[i], state) && is_next(i, reached))
      reached[i / 64] |= std::uint64_t{1} << (i % 64);
}

int LandmarkCount::evaluate(const State& state, const std::uint64_t* reached) const {
  int result = 0;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const auto& landmark = landmarks_[i];
    if (!has(reached, i)) {
      ++result;
    } else if (!is_true(landmark, state)) {
      const bool is_needed =
        landmark.is_goal ||
        std::ranges::any_of(landmark.directly_after, [&](auto x) { return !has(reached, x); });
      result += is_needed ? 1 : 0;
    }
  }
  return result;
}

bool LandmarkCount::is_preferred(const TaskOperator& op, const State& state,
                                 const std::uint64_t* reached) const {
  return std::ranges::any_of(op.effects, [&](const TaskEffect& x) {
    const auto& of_fact = of_fact_[task_.fact_index(x.fact)];
    return !of_fact.empty() && holds(x.condition, state) &&
           std::ranges::any_of(of_fact,
                               [&](auto i) { return !has(reached, i) && is_next(i, reached); });
  });
}

} // namespace castor::planning
