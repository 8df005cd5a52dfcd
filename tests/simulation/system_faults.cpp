#include "castor/tests/simulation/system_faults.hpp"

#include "castor/actors/faults/seeded_random.hpp"

#include <array>
#include <string>
#include <utility>

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

std::string any_node(SeededRandom& random) {
  return std::string{machines[1 + random.below(machines.size() - 1)]};
}

LinkTarget any_link(SeededRandom& random) {
  static constexpr std::array<std::pair<int, int>, 3> links{{{0, 1}, {0, 2}, {1, 2}}};
  auto [a, b] = random.one_of(links);
  return {std::string{machines[std::size_t(a)]}, std::string{machines[std::size_t(b)]}};
}

Fault any_fault(SeededRandom& random) {
  static const std::array<std::string, 6> components{"a1", "a2", "b1", "b2", "c1", "c2"};
  static const std::array<std::string, 3> task_managers{"a_tm", "b_tm", "c_tm"};
  static const std::array<std::string, 3> working_memories{"a_wm", "b_wm", "c_wm"};
  auto kind = random.below(20);
  if (kind < 6)
    return Crash{{random.one_of(components), {}}};
  if (kind < 7)
    return Crash{{random.one_of(task_managers), {}}};
  if (kind < 9)
    return Crash{{random.one_of(working_memories), {}}};
  if (kind < 11)
    return Hang{{random.one_of(components), {}}, milliseconds{random.between(10, 800)}};
  if (kind < 13)
    return Kill{{any_node(random)}};
  if (kind < 15)
    return Stop{{any_node(random)}, separation(random)};
  if (kind < 17)
    return Partition{{any_node(random)}, {}, separation(random)};
  if (kind < 19)
    return Drop{{std::uint32_t(random.between(1'000, 30'000))},
                any_link(random),
                milliseconds{random.between(10, 500)}};
  return Delay{milliseconds{random.between(1, 100)}, any_link(random),
               milliseconds{random.between(10, 500)}};
}

} // namespace

FaultPlan system_faults(std::uint64_t seed) {
  FaultPlan result;
  result.file = "seed " + std::to_string(seed);
  result.seed = seed;
  SeededRandom random{seed, "system faults"};
  for (auto count = random.below(7); count > 0; --count) {
    At at{milliseconds{random.between(0, time_of_faults.count())}};
    result.statements.push_back({at, {any_fault(random)}, {}, {}});
  }
  return result;
}

milliseconds time_until_return(std::uint64_t seed, Timestamp killed) {
  SeededRandom random{seed, "return", std::uint64_t(killed.count())};
  return milliseconds{random.between(5, random.below(3) == 0 ? 4000 : 300)};
}

} // namespace castor::simulation
