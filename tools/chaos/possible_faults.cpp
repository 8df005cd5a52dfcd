#include "castor/tools/chaos/possible_faults.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace castor::faults {

namespace {

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

using Faults = std::vector<Fault>;

template <class T>
Faults at_components(const FaultTargets& x) {
  Faults result;
  for (auto& y : x.components)
    if (y.is_any()) {
      T fault{};
      fault.component.name = y.name;
      result.push_back(std::move(fault));
    }
  return result;
}

template <class T>
Faults at_isolated(const FaultTargets& x) {
  Faults result;
  for (auto& y : x.components)
    if (y.isolated) {
      T fault{};
      fault.process.name = y.name;
      result.push_back(std::move(fault));
    }
  return result;
}

template <class T>
Faults at_nodes(const FaultTargets& x) {
  Faults result;
  for (auto& name : x.nodes) {
    T fault{};
    fault.process.name = name;
    result.push_back(std::move(fault));
  }
  return result;
}

/// Of nodes, and of isolated components.
template <class T>
Faults at_processes(const FaultTargets& x) {
  auto result = at_nodes<T>(x);
  for (auto& fault : at_isolated<T>(x))
    result.push_back(std::move(fault));
  return result;
}

Faults shortages_of_descriptors(const FaultTargets& x) {
  if (x.components.empty())
    return {};
  auto result = at_processes<UseUpDescriptors>(x);
  result.push_back(UseUpDescriptors{{std::string{coordinator}}, {}});
  return result;
}

Faults partitions(const FaultTargets& x) {
  Faults result;
  for (auto& name : x.nodes)
    result.push_back(Partition{{name}, {}, {}});
  return result;
}

template <class T>
Faults at_links(const FaultTargets& x) {
  Faults result;
  for (std::size_t i = 0; i < x.nodes.size(); ++i) {
    result.push_back(T{{}, {x.nodes[i], std::string{coordinator}}, {}});
    for (std::size_t j = 0; j < i; ++j)
      result.push_back(T{{}, {x.nodes[i], x.nodes[j]}, {}});
  }
  return result;
}

template <class T>
Faults at_journals(const FaultTargets& x) {
  Faults result;
  for (auto& y : x.subarchitectures)
    if (y.has_journal) {
      T fault{};
      fault.memory.subarchitecture = y.name;
      result.push_back(std::move(fault));
    }
  return result;
}

/// Without its journal, a working memory would end the system, unless it goes on without.
Faults removals_of_journals(const FaultTargets& x) {
  Faults result;
  for (auto& y : x.subarchitectures)
    if (y.has_journal && y.goes_on_without_journal)
      result.push_back(RemoveJournal{{y.name}});
  return result;
}

/// Working memories that come back with what they held.
Faults crashes_of_memories_with_journal(const FaultTargets& x) {
  Faults result;
  for (auto& y : x.components)
    for (auto& z : x.subarchitectures)
      if (y.kind == ComponentKind::working_memory && y.subarchitecture == z.name && z.has_journal)
        result.push_back(Crash{{y.name, {}}});
  return result;
}

Faults clock_jumps(const FaultTargets& x) {
  Faults result;
  for (auto& y : x.subarchitectures)
    result.push_back(JumpClock{{y.name}, {}});
  return result;
}

void nothing(Fault&, FaultDraws&) {}

template <class T>
void draw_duration(Fault& x, FaultDraws& draws) {
  std::get<T>(x).duration = draws.duration();
}

template <class T>
void draw_lateness(Fault& x, FaultDraws& draws) {
  std::get<T>(x).by = draws.lateness();
  draw_duration<T>(x, draws);
}

void draw_callback(Fault& x, FaultDraws& draws) {
  std::get<Throw>(x).callback =
    static_cast<std::uint32_t>(draws.random.between(1, draws.callbacks));
}

void draw_block(Fault& x, FaultDraws& draws) {
  std::get<Block>(x).phase =
    draws.random.below(2) == 0 ? Block::Phase::configure : Block::Phase::start;
  draw_duration<Block>(x, draws);
}

void draw_part(Fault& x, FaultDraws& draws) {
  std::get<Drop>(x).part = draws.part();
  draw_duration<Drop>(x, draws);
}

void draw_jump(Fault& x, FaultDraws& draws) {
  auto ms = draws.random.between(1, longest_jump_ms);
  std::get<JumpClock>(x).by = (draws.random.below(3) == 0 ? -ms : ms) * millisecond;
}

/// `duplicate` and `reorder` are not among them: links are streams.
constexpr std::array kinds{
  FaultKind{6, at_components<Crash>, nothing, false, true},
  FaultKind{4, at_components<Throw>, draw_callback, true, true},
  FaultKind{3, at_components<Hang>, draw_duration<Hang>, true, false},
  FaultKind{3, at_components<Slow>, draw_lateness<Slow>, true, false},
  FaultKind{1, at_components<Block>, draw_block, false, false, true},
  FaultKind{3, at_isolated<Kill>, nothing, false, true},
  FaultKind{2, at_isolated<Stop>, draw_duration<Stop>},
  FaultKind{2, at_nodes<Kill>, nothing},
  FaultKind{3, at_nodes<Stop>, draw_duration<Stop>},
  FaultKind{2, shortages_of_descriptors, draw_duration<UseUpDescriptors>},
  FaultKind{2, at_processes<Flood>, draw_duration<Flood>},
  FaultKind{3, partitions, draw_duration<Partition>},
  FaultKind{3, at_links<Delay>, draw_lateness<Delay>},
  FaultKind{2, at_links<Drop>, draw_part},
  FaultKind{2, crashes_of_memories_with_journal, nothing, false, true},
  FaultKind{2, at_journals<FailJournal>, draw_duration<FailJournal>, false, true},
  FaultKind{2, at_journals<SlowJournal>, draw_lateness<SlowJournal>},
  FaultKind{1, removals_of_journals, nothing},
  FaultKind{1, at_journals<ClaimJournal>, nothing},
  FaultKind{2, clock_jumps, draw_jump},
};

} // namespace

Timestamp FaultDraws::duration() {
  return random_duration(random, longest);
}

Timestamp FaultDraws::lateness() {
  return random_duration(random, std::min(longest, 100 * millisecond));
}

Percent FaultDraws::part() {
  return {static_cast<std::uint32_t>(1000 * random.between(1, highest_percent))};
}

std::span<const FaultKind> fault_kinds() {
  return kinds;
}

} // namespace castor::faults
