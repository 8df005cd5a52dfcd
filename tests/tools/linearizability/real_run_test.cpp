#include "castor/tests/tools/linearizability/real_run.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace castor::linearizability {

TEST(RealRuns, ComponentsSeeLinearizableEntries) {
  std::set<std::pair<OperationKind, Status>> seen;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto result = run_for_real(seed);
    ASSERT_FALSE(result.is_wrong())
      << "castor_real_runs --runs 1 --seed " << seed << " --show\n"
      << result.description << "\n"
      << (result.findings.empty() ? "" : result.findings.front()) << result.verdict.report;
    std::map<std::uint32_t, int> operations;
    for (auto& x : result.history) {
      operations[x.entry] += x.kind != OperationKind::lapse;
      if (!x.pending())
        seen.emplace(x.kind, x.result.status);
    }
    for (auto [entry, count] : operations)
      EXPECT_LE(count, 200);
  }
  using enum OperationKind;
  using enum Status;
  for (auto kind : {add, overwrite, remove, read, exists, version, lock, try_lock, unlock})
    EXPECT_TRUE(seen.contains({kind, ok})) << to_string(kind);
  EXPECT_TRUE(seen.contains({overwrite, inconsistent}));
  EXPECT_TRUE(seen.contains({overwrite, locked}));
  EXPECT_TRUE(seen.contains({lock, does_not_exist}));
}

} // namespace castor::linearizability
