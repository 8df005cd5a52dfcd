#include "castor/tools/simulation/memory_simulation.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace castor::linearizability {

namespace {

std::string lines(const History& history) {
  std::string result;
  for (auto& x : history)
    result += std::to_string(x.entry) + ": " + to_string(x) + "\n";
  return result;
}

} // namespace

TEST(Simulation, WorkingMemoriesAreLinearizable) {
  Simulation simulation;
  int undecided = 0;
  for (std::uint64_t seed = 1; seed <= 2'000; ++seed) {
    auto result = simulation.run(seed);
    ASSERT_FALSE(result.is_wrong()) << "castor_simulation --seed " << seed << "\n"
                                    << to_string(result);
    undecided += !result.ok();
  }
  EXPECT_LT(undecided, 5);
}

TEST(Simulation, ASeedGivesTheSameHistoryAgain) {
  Simulation simulation;
  Simulation another;
  another.run(99);
  for (std::uint64_t seed : {1, 2, 3, 1, 3}) {
    auto history = lines(simulation.run(seed).history);
    EXPECT_EQ(history, lines(another.run(seed).history));
  }
}

TEST(Simulation, HistoriesShowAllThatCanHappen) {
  Simulation simulation;
  std::set<std::pair<OperationKind, Status>> seen;
  int pending = 0;
  int lapses = 0;
  int proven_waits = 0;
  for (std::uint64_t seed = 1; seed <= 340; ++seed)
    for (auto& x : simulation.run(seed).history) {
      EXPECT_LE(x.invoked, x.returned);
      lapses += x.kind == OperationKind::lapse;
      pending += x.pending();
      proven_waits += x.may_wait() && x.arrived_by() < x.returned;
      if (!x.pending())
        seen.emplace(x.kind, x.result.status);
    }
  using enum OperationKind;
  using enum Status;
  for (auto kind : {add, overwrite, remove, read, exists, version, lock, try_lock, unlock})
    EXPECT_TRUE(seen.contains({kind, ok})) << to_string(kind);
  for (auto kind : {overwrite, remove, read, exists, lock, try_lock, unlock})
    EXPECT_TRUE(seen.contains({kind, does_not_exist})) << to_string(kind);
  for (auto kind : {overwrite, remove}) {
    EXPECT_TRUE(seen.contains({kind, locked})) << to_string(kind);
    EXPECT_TRUE(seen.contains({kind, stale})) << to_string(kind);
  }
  EXPECT_TRUE(seen.contains({add, already_exists}));
  EXPECT_TRUE(seen.contains({overwrite, inconsistent}));
  EXPECT_TRUE(seen.contains({version, never_existed}));
  EXPECT_TRUE(seen.contains({try_lock, busy}));
  EXPECT_TRUE(seen.contains({unlock, stale}));
  EXPECT_TRUE(seen.contains({lock, timed_out}));
  EXPECT_TRUE(seen.contains({read, timed_out}));
  EXPECT_GT(pending, 100);
  EXPECT_GT(lapses, 1'000);
  EXPECT_GT(proven_waits, 500);
}

} // namespace castor::linearizability
