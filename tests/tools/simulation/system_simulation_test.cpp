#include "castor/tools/simulation/system_simulation.hpp"

#include "castor/tools/simulation/simulated_journal.hpp"
#include "castor/tools/simulation/system_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <string>
#include <utility>

namespace castor::simulation {

namespace {

using namespace std::chrono_literals;
using testing::IsSubsetOf;
using testing::SizeIs;

std::string lines(const SystemResult& x) {
  std::string result;
  for (auto& operation : x.history)
    result += to_string(operation) + "\n";
  return result;
}

/// The first seed of a system with so many machines.
std::uint64_t seed_with(std::size_t machines) {
  std::uint64_t result = 1;
  while (machine_count(result) != machines)
    ++result;
  return result;
}

faults::FaultPlan plan(Timestamp at, faults::Fault x) {
  faults::FaultPlan result;
  result.statements.push_back({faults::At{at}, {std::move(x)}, {}, {}});
  return result;
}

} // namespace

/// A quarter of the seeds, so that they are run side by side.
class SimulatedSystems : public testing::TestWithParam<int> {};

/// More of them, as many as one likes: castor simulate.
TEST_P(SimulatedSystems, RecoverAndLoseNothingThatIsPromised) {
  constexpr std::uint64_t quarter = CASTOR_SIMULATED_SYSTEMS / 4;
  SystemSimulation simulation;
  int undecided = 0;
  auto first = GetParam() * quarter + 1;
  for (auto seed = first; seed < first + quarter; ++seed) {
    auto result = simulation.run(seed);
    ASSERT_FALSE(result.is_wrong()) << "castor simulate --seed " << seed << "\n"
                                    << to_string(result) << "\nwith\n"
                                    << to_string(minimised(simulation, seed, result.faults));
    undecided += !result.ok();
  }
  EXPECT_LT(undecided, 3);
}

INSTANTIATE_TEST_SUITE_P(, SimulatedSystems, testing::Range(0, 4),
                         [](auto& x) { return "Quarter" + std::to_string(x.param + 1); });

TEST(SystemSimulation, ASeedGivesTheSameRunAgain) {
  SystemSimulation simulation;
  SystemSimulation another;
  another.run(99);
  for (std::uint64_t seed : {1, 2, 3, 45, 160, 1, 3}) {
    auto once = simulation.run(seed);
    auto again = another.run(seed);
    EXPECT_EQ(lines(once), lines(again));
    EXPECT_EQ(once.digest, again.digest);
    EXPECT_EQ(once.steps, again.steps);
  }
}

/// Each has shown a mistake once: of task managers, that may take a component for dead which the
/// coordinator has lost (212174); of calls, of which nothing was to be left (234857); of nodes that
/// take part anew (3276).
TEST(SystemSimulation, WhatWasFoundOnceIsMended) {
  SystemSimulation simulation;
  for (std::uint64_t seed : {212174, 234857, 3276}) {
    auto result = simulation.run(seed);
    EXPECT_TRUE(result.ok()) << "seed " << seed << "\n" << to_string(result);
  }
}

TEST(SystemSimulation, WithoutFaultsNobodyFails) {
  SystemSimulation simulation;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto result = simulation.run(seed, faults::FaultPlan{});
    EXPECT_TRUE(result.ok()) << to_string(result);
    EXPECT_EQ(result.failures, 0u);
    EXPECT_EQ(result.losses, 0u);
  }
}

TEST(SystemSimulation, EveryKindOfFaultHasItsEffect) {
  SystemSimulation simulation;
  auto failures = [&](faults::Fault x) {
    auto result = simulation.run(seed_with(3), plan(500ms, std::move(x)));
    EXPECT_TRUE(result.ok()) << to_string(result);
    return result.failures;
  };
  auto separation = 2 * link_patience;
  EXPECT_GE(failures(faults::Crash{{"a1", {}}}), 1u);
  // With all that it takes along.
  EXPECT_GE(failures(faults::Crash{{"b_wm", {}}}), 4u);
  EXPECT_GE(failures(faults::Kill{{"node1"}}), 3u);
  EXPECT_GE(failures(faults::Stop{{"node2"}, separation}), 3u);
  EXPECT_GE(failures(faults::Partition{{"node2"}, {}, separation}), 3u);
  EXPECT_EQ(failures(faults::Stop{{"node2"}, link_patience / 3}), 0u);
  EXPECT_EQ(failures(faults::Partition{{"node2"}, {}, link_patience / 3}), 0u);
  EXPECT_EQ(failures(faults::Hang{{"a1", {}}, 100ms}), 0u);
}

TEST(SystemSimulation, RunsShowAllThatCanHappen) {
  using linearizability::OperationKind;
  using linearizability::Status;
  SystemSimulation simulation;
  std::set<std::pair<OperationKind, Status>> seen;
  std::size_t pending = 0;
  std::size_t losses = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    for (auto& x : simulation.run(seed).history) {
      pending += x.pending();
      losses += x.kind == OperationKind::loss;
      if (!x.pending())
        seen.emplace(x.kind, x.result.status);
    }
  using enum OperationKind;
  for (auto kind : {add, overwrite, remove, read, exists, version, lock, try_lock, unlock})
    EXPECT_TRUE(seen.contains({kind, Status::ok})) << to_string(kind);
  EXPECT_TRUE(seen.contains({overwrite, Status::locked}));
  EXPECT_TRUE(seen.contains({overwrite, Status::stale}));
  EXPECT_GT(pending, 100u);
  EXPECT_GT(losses, 100u);
}

TEST(SystemSimulation, NothingThatCanHappenNeverDoes) {
  SystemSimulation simulation;
  auto all = Happenings::everything();
  // All but what takes thousands of systems.
  for (std::uint64_t seed = 1; seed <= 400; ++seed)
    all.add(simulation.run(seed).happened);
  EXPECT_THAT(all.never(), IsSubsetOf({"calls: given up by its server", "calls: not written",
                                       "calls: not answered in time",
                                       "journals: lost changes reached the bound"}));
}

TEST(SystemSimulation, AJournalOutlivesItsWorkingMemory) {
  std::uint64_t seed = 1;
  while (journal_mode(seed) != JournalMode::full || machine_count(seed) != 1)
    ++seed;
  SystemSimulation simulation;
  auto result = simulation.run(seed, plan(900ms, faults::Crash{{"a_wm", {}}}));
  EXPECT_TRUE(result.ok()) << to_string(result);
  EXPECT_EQ(result.losses, 0u);
  EXPECT_EQ(result.happened.count("journals", "opened"), 3u);
  EXPECT_EQ(result.happened.count("journals", "opened again"), 1u);
}

TEST(SystemSimulation, ABatchedJournalMayLackTheLastChangesOfAProcessThatIsKilled) {
  SystemSimulation simulation;
  std::uint64_t found = 0, lost = 0;
  for (std::uint64_t seed = 1; lost == 0; ++seed) {
    ASSERT_LT(seed, 2000u);
    if (journal_mode(seed) != JournalMode::batched || machine_count(seed) == 1)
      continue;
    auto result = simulation.run(seed, plan(700ms, faults::Kill{{"node1"}}));
    ASSERT_TRUE(result.ok()) << "seed " << seed << "\n" << to_string(result);
    EXPECT_EQ(result.losses, 0u);
    found += result.happened.count("journals", "change with an event found in the journal");
    lost += result.happened.count("journals", "change with an event lost, within the bound");
  }
  EXPECT_GT(found, lost);
}

TEST(SystemSimulation, ABatchedJournalThatIsSlowLacksAsManyChangesAsItMay) {
  SystemSimulation simulation;
  auto faults = plan(500ms, faults::SlowJournal{{"b"}, 1000ms, 1000ms});
  faults.statements.push_back({faults::At{900ms}, {faults::Kill{{"node1"}}}, {}, {}});
  for (std::uint64_t seed = 1, at_bound = 0; at_bound == 0; ++seed) {
    ASSERT_LT(seed, 2000u);
    if (journal_mode(seed) != JournalMode::batched || machine_count(seed) == 1)
      continue;
    auto result = simulation.run(seed, faults);
    ASSERT_TRUE(result.ok()) << "seed " << seed << "\n" << to_string(result);
    at_bound = result.happened.count("journals", "lost changes reached the bound");
  }
}

TEST(SystemSimulation, WaitsEndThoughAClockGoesBackToBeforeTheBeginning) {
  SystemSimulation simulation;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    for (auto* memory : {"a", "b", "c"}) {
      auto result = simulation.run(seed, plan(1ms, faults::JumpClock{{memory}, -700ms}));
      ASSERT_TRUE(result.ok()) << "seed " << seed << "\n" << to_string(result);
    }
}

TEST(SimulatedDisk, IsTakenAwayFromWhoeverWritesItAndKeepsWhatWasAppended) {
  SimulatedDisk disk;
  JournalOptions options;
  options.mode = JournalMode::full;
  auto first = disk.open("a", options, {});
  JournalRecord record;
  record.sequence = 1;
  record.id = "x";
  auto group = std::make_shared<JournalGroup>();
  group->push_back(record);
  first.file->append({group});
  auto second = disk.open("a", options, {});
  EXPECT_EQ(second.session, 2u);
  EXPECT_EQ(second.image.sequence, 1u);
  EXPECT_THAT(second.image.entries, SizeIs(1));
  EXPECT_THROW(first.file->append({group}), JournalError);
  EXPECT_THAT(disk.records("a"), SizeIs(1));
  EXPECT_THAT(disk.records("b"), SizeIs(0));
}

TEST(SimulatedDisk, BeginsAnotherIncarnationIfAcknowledgedChangesMayBeMissing) {
  SimulatedDisk disk;
  JournalOptions full, batched;
  full.mode = JournalMode::full;
  batched.mode = JournalMode::batched;
  auto incarnation = [&](const JournalOptions& options) {
    return disk.open("a", options, {}).incarnation;
  };
  EXPECT_EQ(incarnation(full), 0u);
  EXPECT_EQ(incarnation(batched), 0u) << "a full journal lacks nothing";
  auto opened = disk.open("a", batched, {});
  EXPECT_EQ(opened.incarnation, 1u);
  EXPECT_EQ(opened.image.sequence, numbers_per_incarnation);
  opened.file->close();
  EXPECT_EQ(incarnation(full), 1u) << "it was closed in order";
}

TEST(SystemFaults, FollowFromTheSeed) {
  EXPECT_EQ(system_faults(7), system_faults(7));
  std::set<std::size_t> kinds;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    for (auto& x : system_faults(seed).statements)
      kinds.insert(x.faults.front().index());
  EXPECT_THAT(kinds, SizeIs(10));
}

} // namespace castor::simulation
