#include "castor/tools/chaos/coverage.hpp"

#include "castor/tests/tools/chaos/support.hpp"

#include <gmock/gmock.h>

namespace castor::faults {

namespace {

FaultRecord record(const std::string& text, FaultState state) {
  auto fault = test::plan_of("at 1s " + text).statements.front().faults.front();
  FaultRecord result;
  result.kind = kind_of(fault);
  result.target = target_of(fault);
  result.state = state;
  return result;
}

TEST(Coverage, KnowsWhatASystemCouldBeHitBy) {
  const Coverage coverage{test::small_system()};
  // One component with crash, throw, hang, block and slow, one clock, and the descriptors of one
  // process.
  EXPECT_EQ(coverage.possible(), 7U);
  EXPECT_EQ(coverage.hit(), 0U);
  EXPECT_TRUE(Coverage{}.empty());
}

TEST(Coverage, CountsHitsAndMisses) {
  Coverage coverage{test::small_system()};
  std::vector<FaultRecord> faults{record("crash worker", FaultState::happened),
                                  record("crash worker", FaultState::happened),
                                  record("hang worker for 1s", FaultState::never),
                                  record("throw in worker", FaultState::not_injected)};
  coverage.add(faults);
  coverage.add(faults);
  EXPECT_EQ(coverage.hit(), 1U);
  EXPECT_EQ(to_text(coverage), "1 of 7 pairs of a fault and a target were hit\n"
                               "\n"
                               "            block    crash     hang     slow    throw\n"
                               "  worker        .        4     . -2        .     . -2\n"
                               "\n"
                               "        jump clock\n"
                               "  only           .\n"
                               "\n"
                               "               use up descriptors\n"
                               "  coordinator                   .\n");
}

TEST(Coverage, HasATableForTargetsOfOneKind) {
  auto tables = Coverage{test::table_top()}.tables();
  auto has_row = [](const std::string& target) {
    return testing::Contains(
      testing::Field(&Coverage::Table::rows, testing::Contains(testing::Key(target))));
  };
  for (auto target : {"segmentor", "tracker", "binder", "camera", "vision_wm", "vision", "node1",
                      "coordinator and node1", "node1 and node2"})
    EXPECT_THAT(tables, has_row(target)) << target;
  for (auto& table : tables)
    for (auto& [target, cells] : table.rows)
      EXPECT_EQ(cells.size(), table.kinds.size()) << target;
}

TEST(Coverage, KeepsWhatOnlyPlansOfPeopleHit) {
  Coverage coverage{test::small_system()};
  coverage.add(std::vector{record("crash only_tm", FaultState::happened)});
  EXPECT_EQ(coverage.possible(), 8U);
  EXPECT_EQ(coverage.hit(), 1U);
}

} // namespace

} // namespace castor::faults
