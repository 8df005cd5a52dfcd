#include "castor/actors/faults/random_plan.hpp"

#include "castor/actors/faults/draw.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace castor::faults {

namespace {

constexpr Timestamp millisecond{1000};
constexpr std::int64_t most_callbacks = 20;
constexpr std::int64_t highest_percent = 30;
constexpr std::int64_t longest_jump_ms = 10'000;

/// As often short as long, from 5 ms on.
Timestamp random_duration(SeededRandom& random, Timestamp longest) {
  constexpr std::int64_t shortest_ms = 5;
  auto most_doublings = 0;
  while ((shortest_ms << (most_doublings + 1)) * millisecond < longest)
    ++most_doublings;
  auto shortest = shortest_ms << random.between(0, most_doublings);
  return std::min(longest, random.between(shortest, 2 * shortest) * millisecond);
}

/// What there is to draw from.
struct Choice {
  const FaultTargets& targets;
  SeededRandom& random;
  Timestamp longest;

  Timestamp duration() const { return random_duration(random, longest); }
  Timestamp little() const { return random_duration(random, std::min(longest, 100 * millisecond)); }
  Percent part() const {
    return {static_cast<std::uint32_t>(1000 * random.between(1, highest_percent))};
  }
};

struct Kind {
  /// Of all kinds that are possible in the system.
  std::size_t weight;
  bool (*possible)(const FaultTargets&);
  Fault (*make)(Choice&);
};

bool has_component(const FaultTargets& x) {
  return std::ranges::any_of(x.components, &FaultTargets::Component::is_any);
}
bool has_isolated(const FaultTargets& x) {
  return std::ranges::any_of(x.components, &FaultTargets::Component::isolated);
}
bool has_node(const FaultTargets& x) {
  return !x.nodes.empty();
}
bool has_memory(const FaultTargets& x) {
  return !x.subarchitectures.empty();
}
bool has_journal(const FaultTargets& x) {
  return std::ranges::any_of(x.subarchitectures, &FaultTargets::Subarchitecture::has_journal);
}

Fault kill_isolated(Choice& x) {
  std::vector<std::string> names;
  for (auto& y : x.targets.components)
    if (y.isolated)
      names.push_back(y.name);
  return Kill{{x.random.one_of(names)}};
}

Fault crash_memory_with_journal(Choice& x) {
  std::vector<std::string> names;
  for (auto& y : x.targets.components)
    for (auto& z : x.targets.subarchitectures)
      if (y.kind == ComponentKind::working_memory && y.subarchitecture == z.name && z.has_journal)
        names.push_back(y.name);
  return Crash{{x.random.one_of(names), {}}};
}

Fault jump(Choice& x) {
  auto ms = x.random.between(1, longest_jump_ms);
  return JumpClock{{}, (x.random.below(3) == 0 ? -ms : ms) * millisecond};
}

Fault throw_somewhere(Choice& x) {
  return Throw{{}, static_cast<std::uint32_t>(x.random.between(1, most_callbacks))};
}

const std::array kinds{
  Kind{6, has_component, [](Choice&) -> Fault { return Crash{}; }},
  Kind{4, has_component, throw_somewhere},
  Kind{3, has_component,
       [](Choice& x) -> Fault {
         return Hang{{}, x.duration()};
       }},
  Kind{3, has_component,
       [](Choice& x) -> Fault {
         return Slow{{}, x.little(), x.duration()};
       }},
  Kind{3, has_isolated, kill_isolated},
  Kind{2, has_node, [](Choice&) -> Fault { return Kill{}; }},
  Kind{3, has_node,
       [](Choice& x) -> Fault {
         return Stop{{}, x.duration()};
       }},
  Kind{3, has_node,
       [](Choice& x) -> Fault {
         return Partition{{x.random.one_of(x.targets.nodes)}, {}, x.duration()};
       }},
  Kind{3, has_node,
       [](Choice& x) -> Fault {
         return Delay{x.little(), {}, x.duration()};
       }},
  Kind{2, has_node,
       [](Choice& x) -> Fault {
         return Drop{x.part(), {}, x.duration()};
       }},
  Kind{1, has_node,
       [](Choice& x) -> Fault {
         return Duplicate{x.part(), {}, x.duration()};
       }},
  Kind{1, has_node,
       [](Choice& x) -> Fault {
         return Reorder{x.part(), {}, x.duration()};
       }},
  Kind{2, has_journal, crash_memory_with_journal},
  Kind{2, has_journal,
       [](Choice& x) -> Fault {
         return FailJournal{{}, x.duration()};
       }},
  Kind{2, has_journal,
       [](Choice& x) -> Fault {
         return SlowJournal{{}, x.little(), x.duration()};
       }},
  Kind{2, has_memory, jump},
};

/// Those that are possible, each as often as its weight says.
std::vector<const Kind*> possible_kinds(const FaultTargets& targets) {
  std::vector<const Kind*> result;
  for (auto& kind : kinds)
    if (kind.possible(targets))
      result.insert(result.end(), kind.weight, &kind);
  return result;
}

} // namespace

FaultPlan random_plan(const FaultTargets& targets, std::uint64_t seed, Timestamp duration,
                      const RandomPlanOptions& options) {
  FaultPlan result;
  result.file = "seed " + std::to_string(seed);
  result.seed = seed;
  auto possible = possible_kinds(targets);
  if (possible.empty())
    return result;
  SeededRandom random{seed, "random plan"};
  auto end = duration - std::min(options.rest, duration / 4);
  auto most_pause = std::max<std::int64_t>(2 * (options.interval / millisecond), 1);
  Timestamp at{0};
  while (true) {
    at += random.between(1, most_pause) * millisecond;
    if (at >= end)
      return result;
    Choice choice{targets, random, std::min(options.longest, end - at)};
    auto fault = draw_targets(random.one_of(possible)->make(choice), targets, random);
    result.statements.push_back({At{at}, {std::move(fault)}, {}, {}});
  }
}

} // namespace castor::faults
