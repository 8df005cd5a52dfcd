#include "castor/tools/simulation/system_faults.hpp"

#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/chaos/seeded_random.hpp"
#include "castor/tools/simulation/simulated_architecture.hpp"

#include <array>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace castor::simulation {

namespace {

using namespace faults;
using std::chrono::milliseconds;

/// Apart for a moment, or for good as far as anybody knows.
Timestamp separation(SeededRandom& random) {
  auto is_long = random.below(4) == 0;
  return is_long ? 3 * link_patience + milliseconds{random.between(0, 500)}
                 : milliseconds{random.between(10, link_patience.count() / 3)};
}

std::string any_node(SeededRandom& random, std::size_t count) {
  return std::string{machine_names[1 + random.below(count - 1)]};
}

LinkTarget any_link(SeededRandom& random, std::size_t count) {
  static constexpr std::array<std::pair<int, int>, 3> links{{{0, 1}, {0, 2}, {1, 2}}};
  auto [a, b] = links[random.below(count == 2 ? 1 : links.size())];
  return {std::string{machine_names[std::size_t(a)]}, std::string{machine_names[std::size_t(b)]}};
}

/// What can happen within one process.
Fault local_fault(SeededRandom& random, bool journals) {
  static const std::array<std::string, 6> components{"a1", "a2", "b1", "b2", "c1", "c2"};
  static const std::array<std::string, 3> task_managers{"a_tm", "b_tm", "c_tm"};
  static const std::array<std::string, 3> working_memories{"a_wm", "b_wm", "c_wm"};
  static const std::array<std::string, 3> subarchitectures{"a", "b", "c"};
  auto kind = random.below(journals ? 17 : 13);
  if (kind < 6)
    return Crash{{random.one_of(components), {}}};
  if (kind < 7)
    return Crash{{random.one_of(task_managers), {}}};
  if (kind < 9)
    return Crash{{random.one_of(working_memories), {}}};
  if (kind < 11)
    return Hang{{random.one_of(components), {}}, milliseconds{random.between(10, 800)}};
  if (kind < 13)
    return faults::JumpClock{{random.one_of(subarchitectures)},
                             random.below(3) == 0 ? -milliseconds{random.between(1, 500)}
                                                  : milliseconds{random.between(1, 2000)}};
  if (kind < 16)
    return SlowJournal{{random.one_of(subarchitectures)},
                       milliseconds{random.between(1, 200)},
                       milliseconds{random.between(10, 1000)}};
  return FailJournal{{random.one_of(subarchitectures)}, milliseconds{random.between(1, 200)}};
}

/// What can happen to processes and what is between them.
Fault distributed_fault(SeededRandom& random, std::size_t count) {
  auto kind = random.below(9);
  if (kind < 2)
    return Kill{{any_node(random, count)}};
  if (kind < 4)
    return Stop{{any_node(random, count)}, separation(random)};
  if (kind < 6)
    return Partition{{any_node(random, count)}, {}, separation(random)};
  if (kind < 8)
    return Drop{{std::uint32_t(random.between(1'000, 30'000))},
                any_link(random, count),
                milliseconds{random.between(10, 500)}};
  return Delay{milliseconds{random.between(1, 100)}, any_link(random, count),
               milliseconds{random.between(10, 500)}};
}

/// A node is killed while the journal of a working memory there is late.
std::vector<Statement> kill_with_late_journal(SeededRandom& random, std::size_t count) {
  auto node = 1 + random.below(count - 1);
  auto subarchitecture = std::string(1, char('a' + node));
  auto begin = milliseconds{random.between(0, time_of_faults.count())};
  auto late_by = milliseconds{random.between(50, 1000)};
  auto killed = begin + milliseconds{random.between(0, 2 * late_by.count())};
  return {{At{begin}, {SlowJournal{{subarchitecture}, late_by, 2 * late_by}}, {}, {}},
          {At{killed}, {Kill{{std::string{machine_names[node]}}}}, {}, {}}};
}

Fault any_fault(SeededRandom& random, std::size_t count, bool journals) {
  return count == 1 || random.below(20) < 12 ? local_fault(random, journals)
                                             : distributed_fault(random, count);
}

} // namespace

std::size_t machine_count(std::uint64_t seed) {
  SeededRandom random{seed, "machines"};
  return 1 + random.below(machine_names.size());
}

JournalMode journal_mode(std::uint64_t seed) {
  SeededRandom random{seed, "journals"};
  switch (random.below(5)) {
    case 0:
      return JournalMode::full;
    case 1:
      return JournalMode::batched;
    default:
      return JournalMode::off;
  }
}

namespace {

template <class T, class... Others>
constexpr bool is_one_of = (std::is_same_v<T, Others> || ...);

/// Why the simulation cannot do what a statement says; empty if it can.
std::string why_not_simulated(const Statement& x) {
  if (!std::holds_alternative<At>(x.trigger))
    return "a simulation injects faults at given times only";
  if (x.faults.size() != 1)
    return "a simulation does not draw faults";
  return std::visit(
    [](const auto& fault) -> std::string {
      using T = std::decay_t<decltype(fault)>;
      if (is_one_of<T, Throw, Block, Slow, Continue, UseUpDescriptors, Flood, Duplicate, Reorder,
                    RemoveJournal, ClaimJournal>)
        return "this kind of fault is not simulated";
      if constexpr (requires { fault.duration; })
        if (!fault.duration)
          return "a simulation has to know how long it lasts";
      bool is_any = false;
      if constexpr (requires { fault.component; })
        is_any = fault.component.is_any();
      else if constexpr (requires { fault.process; })
        is_any = fault.process.is_any();
      else if constexpr (requires { fault.memory; })
        is_any = fault.memory.is_any();
      else if constexpr (requires { fault.link; })
        is_any = fault.link.is_any();
      else
        is_any = fault.group.size() != 1 || !fault.from.empty();
      return is_any ? "a simulation has to know the one that it concerns" : "";
    },
    x.faults.front());
}

} // namespace

std::vector<Diagnostic> check_simulated(const FaultPlan& plan, std::uint64_t seed) {
  ArchitectureVariant variant;
  variant.machines = machine_count(seed);
  variant.journals = journal_mode(seed);
  std::vector<std::string> nodes;
  for (std::size_t x = 1; x < variant.machines; ++x)
    nodes.emplace_back(machine_names[x]);
  auto result = check_plan(plan, targets_of(simulated_architecture(variant), nodes));
  for (auto& x : plan.statements)
    if (auto why = why_not_simulated(x); !why.empty())
      result.push_back({Severity::error,
                        x.where,
                        x.line,
                        {},
                        why,
                        "write it as in `at 300ms crash a1` or `at 1s partition node1 for 2s`"});
  return result;
}

FaultPlan system_faults(std::uint64_t seed) {
  FaultPlan result;
  result.file = "seed " + std::to_string(seed);
  result.seed = seed;
  SeededRandom random{seed, "system faults"};
  auto count = machine_count(seed);
  auto journals = journal_mode(seed) != JournalMode::off;
  for (auto left = random.below(7); left > 0; --left) {
    At at{milliseconds{random.between(0, time_of_faults.count())}};
    result.statements.push_back({at, {any_fault(random, count, journals)}, {}, {}});
  }
  if (journals && count > 1 && random.below(4) == 0)
    for (auto& x : kill_with_late_journal(random, count))
      result.statements.push_back(std::move(x));
  return result;
}

milliseconds time_until_return(std::uint64_t seed, Timestamp killed) {
  SeededRandom random{seed, "return", std::uint64_t(killed.count())};
  return milliseconds{random.between(5, random.below(3) == 0 ? 4000 : 300)};
}

} // namespace castor::simulation
