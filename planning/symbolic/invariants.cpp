#include "castor/planning/symbolic/invariants.hpp"

#include <algorithm>
#include <compare>
#include <deque>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

constexpr std::size_t most_candidates = 300;
constexpr std::size_t most_parts = 5;

/// Effects that all candidates together are verified with.
constexpr std::size_t most_work = 100'000'000;

/// Atoms of a predicate: for each parameter the argument that it is. One argument may be none, the
/// one that is counted.
struct InvariantPart {
  int predicate = 0;
  std::vector<std::size_t> arguments;

  friend auto operator<=>(const InvariantPart&, const InvariantPart&) = default;
};

/// Parts of different predicates, in ascending order.
using InvariantCandidate = std::vector<InvariantPart>;

bool has(const std::vector<int>& sorted, int x) {
  return std::ranges::binary_search(sorted, x);
}

class InvariantFinder {
public:
  InvariantFinder(const GroundTask& task, LimitWatch& watch)
    : task_(task), watch_(watch), is_initial_(task.atoms.size(), false) {
    for (const int x : task.initial)
      is_initial_[static_cast<std::size_t>(x)] = true;
  }

  MutexGroups run() {
    add_first_candidates();
    while (!queue_.empty() && work_ < most_work) {
      const auto candidate = std::move(queue_.front());
      queue_.pop_front();
      verify(candidate);
    }
    return {found_.begin(), found_.end()};
  }

private:
  struct Group {
    std::vector<int> atoms;
    std::size_t initially_true = 0;
    bool is_bad = false;
  };

  void enqueue(InvariantCandidate candidate) {
    if (known_.size() < most_candidates && known_.insert(candidate).second)
      queue_.push_back(std::move(candidate));
  }

  /// Each predicate, with each of its arguments counted, and with none.
  void add_first_candidates() {
    std::map<int, std::size_t> arities;
    for (std::size_t i = 0; i < task_.atoms.size(); ++i)
      if (!task_.is_derived[i])
        arities[task_.atoms[i].front()] = task_.atoms[i].size() - 1;
    for (const auto& [predicate, arity] : arities)
      for (std::size_t counted = 0; counted <= arity; ++counted) {
        InvariantPart part{predicate, {}};
        for (std::size_t i = 0; i < arity; ++i)
          if (i != counted)
            part.arguments.push_back(i);
        enqueue({std::move(part)});
      }
  }

  /// Divides the atoms into groups of the same parameters.
  void make_groups(const InvariantCandidate& candidate) {
    groups_.clear();
    group_of_.assign(task_.atoms.size(), -1);
    std::map<std::vector<int>, int> numbers;
    std::vector<int> key;
    for (std::size_t i = 0; i < task_.atoms.size(); ++i) {
      const auto& atom = task_.atoms[i];
      const auto part = std::ranges::find(candidate, atom.front(), &InvariantPart::predicate);
      if (part == candidate.end() || task_.is_derived[i])
        continue;
      key.clear();
      for (const auto x : part->arguments)
        key.push_back(atom[x + 1]);
      const auto [place, is_new] = numbers.try_emplace(key, static_cast<int>(groups_.size()));
      if (is_new)
        groups_.emplace_back();
      auto& group = groups_[static_cast<std::size_t>(place->second)];
      group.atoms.push_back(static_cast<int>(i));
      group.initially_true += is_initial_[i] ? 1 : 0;
      group_of_[i] = place->second;
    }
  }

  int group_of(int atom) const { return group_of_[static_cast<std::size_t>(atom)]; }

  /// Whether the action deletes, of the group of the added atom, one that is true before.
  bool is_balanced(const GroundAction& action, const GroundEffect& added) const {
    return std::ranges::any_of(action.effects, [&](const GroundEffect& x) {
      if (x.is_added || x.atom == added.atom || group_of(x.atom) != group_of(added.atom))
        return false;
      const auto& condition = x.condition;
      const bool is_unconditional = condition.positive.empty() && condition.negative.empty();
      const bool is_same = condition.positive == added.condition.positive &&
                           condition.negative == added.condition.negative;
      return has(action.precondition.positive, x.atom) ? is_unconditional || is_same
                                                       : is_same && has(condition.positive, x.atom);
    });
  }

  void verify(const InvariantCandidate& candidate) {
    make_groups(candidate);
    bool is_extended = false;
    for (const auto& action : task_.actions) {
      // Effects are compared with each other.
      watch_.check(1 + action.effects.size() * action.effects.size() / 64);
      work_ += 1 + action.effects.size();
      for (const auto& effect : action.effects) {
        if (!effect.is_added || group_of(effect.atom) < 0 ||
            has(action.precondition.positive, effect.atom) ||
            has(effect.condition.positive, effect.atom))
          continue;
        auto& group = groups_[static_cast<std::size_t>(group_of(effect.atom))];
        const bool is_heavy = std::ranges::any_of(action.effects, [&](const GroundEffect& x) {
          return x.is_added && x.atom != effect.atom && group_of(x.atom) == group_of(effect.atom);
        });
        if (is_heavy) {
          group.is_bad = true;
        } else if (!group.is_bad && !is_balanced(action, effect)) {
          group.is_bad = true;
          // One failure shows how to go on; that of a group that begins with two is of no use.
          if (!is_extended && group.initially_true <= 1) {
            extend(candidate, action, effect);
            is_extended = true;
          }
        }
      }
    }
    for (auto& x : groups_)
      if (!x.is_bad && x.initially_true <= 1 && x.atoms.size() > 1)
        found_.insert(std::move(x.atoms));
  }

  /// Adds predicates that the action deletes, with the parameters of the added atom's group.
  void extend(const InvariantCandidate& candidate, const GroundAction& action,
              const GroundEffect& added) {
    if (candidate.size() >= most_parts)
      return;
    const auto& atom = task_.atoms[static_cast<std::size_t>(added.atom)];
    const auto part = std::ranges::find(candidate, atom.front(), &InvariantPart::predicate);
    std::vector<int> parameters;
    for (const auto x : part->arguments)
      parameters.push_back(atom[x + 1]);
    for (const auto& x : action.effects) {
      const auto& deleted = task_.atoms[static_cast<std::size_t>(x.atom)];
      const auto arity = deleted.size() - 1;
      if (x.is_added || task_.is_derived[static_cast<std::size_t>(x.atom)] ||
          !(has(action.precondition.positive, x.atom) || has(x.condition.positive, x.atom)) ||
          arity < parameters.size() || arity > parameters.size() + 1 ||
          std::ranges::find(candidate, deleted.front(), &InvariantPart::predicate) !=
            candidate.end())
        continue;
      std::vector<std::size_t> arguments;
      extend(candidate, deleted, parameters, arguments);
    }
  }

  /// All ways to find the parameters among the arguments of the deleted atom.
  void extend(const InvariantCandidate& candidate, const AtomKey& deleted,
              const std::vector<int>& parameters, std::vector<std::size_t>& arguments) {
    if (arguments.size() == parameters.size()) {
      auto extended = candidate;
      extended.push_back({deleted.front(), arguments});
      std::ranges::sort(extended);
      enqueue(std::move(extended));
      return;
    }
    for (std::size_t i = 0; i + 1 < deleted.size(); ++i) {
      if (deleted[i + 1] != parameters[arguments.size()] ||
          std::ranges::find(arguments, i) != arguments.end())
        continue;
      arguments.push_back(i);
      extend(candidate, deleted, parameters, arguments);
      arguments.pop_back();
    }
  }

  const GroundTask& task_;
  LimitWatch& watch_;
  std::vector<bool> is_initial_;
  std::deque<InvariantCandidate> queue_;
  std::set<InvariantCandidate> known_;
  std::set<std::vector<int>> found_;
  std::vector<Group> groups_;
  /// By atom, -1 for none.
  std::vector<int> group_of_;
  std::size_t work_ = 0;
};

} // namespace

MutexGroups find_mutex_groups(const GroundTask& task, LimitWatch& watch) {
  return InvariantFinder(task, watch).run();
}

} // namespace castor::planning
