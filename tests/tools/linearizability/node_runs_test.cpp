#include "castor/tests/tools/linearizability/node_runs.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace castor::linearizability {

/// `castor_real_runs --nodes 3 --faults` does the same for longer.
TEST(NodeRuns, ComponentsOnManyNodesSeeLinearizableEntriesWhateverFails) {
  NodeRuns runs{CASTOR_REAL_RUNS};
  std::set<std::pair<OperationKind, Status>> seen;
  std::size_t pending = 0;
  for (std::uint64_t seed = 12; seed <= 22; ++seed) {
    auto result = runs.run(seed, std::chrono::milliseconds{100});
    ASSERT_FALSE(result.is_wrong())
      << "castor_real_runs --nodes 3 --faults --runs 1 --seed " << seed << " --show\n"
      << result.description << "\n"
      << (result.findings.empty() ? "" : result.findings.front()) << result.verdict.report;
    for (auto& x : result.history) {
      if (x.pending())
        ++pending;
      else
        seen.emplace(x.kind, x.result.status);
    }
  }
  // One or the other comes when everybody has left already.
  EXPECT_GE(runs.faults().size(), fault_kinds - 3);
  EXPECT_GT(pending, 0u);
  using enum OperationKind;
  using enum Status;
  for (auto kind : {add, overwrite, remove, read, exists, version, lock, try_lock, unlock})
    EXPECT_TRUE(seen.contains({kind, ok})) << to_string(kind);
  EXPECT_TRUE(seen.contains({overwrite, inconsistent}));
  EXPECT_TRUE(seen.contains({overwrite, stale}));
  EXPECT_TRUE(seen.contains({overwrite, locked}));
}

} // namespace castor::linearizability
