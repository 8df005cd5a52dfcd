#include "castor/tools/chaos/expected_changes.hpp"

#include "castor/tools/chaos/workload_parser.hpp"
#include "castor/wm/values/reflect.hpp"
#include "castor/wm/values/value.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace castor::faults::test {

struct Meal {
  bool is_served = false;
};
CASTOR_REFLECT(Meal, is_served)

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* line = "each added Meal in kitchen becomes Meal in kitchen where is_served "
                             "== true within 10s";

class ExpectedChangesTest : public testing::Test {
protected:
  /// Which of `line` begins, and which ends.
  static constexpr std::size_t begin = 0;
  static constexpr std::size_t end = 1;

  const Address soup{"kitchen", "soup"};
  const Address cake{"kitchen", "cake"};
  const Workload workload = parse_workload(line, "test.workload").workload.value();
  ExpectedChanges changes{workload.each};
};

TEST_F(ExpectedChangesTest, AreCompleteOnceEachEntryHasBecomeSo) {
  EXPECT_EQ(changes.filters().size(), 2U);
  EXPECT_TRUE(changes.is_complete());
  changes.note(begin, soup);
  changes.note(begin, cake);
  changes.note(end, cake);
  EXPECT_FALSE(changes.is_complete());
  EXPECT_THAT(changes.violations(), ElementsAre("test.workload:1: " + std::string{line} +
                                                ": 1 entry did not: kitchen/soup"));
  changes.note(end, soup);
  EXPECT_TRUE(changes.is_complete());
  EXPECT_EQ(changes.begun(), 2U);
  EXPECT_THAT(changes.violations(), IsEmpty());
}

TEST_F(ExpectedChangesTest, AreSeenInEntriesOfWhichNothingWasTold) {
  changes.note(Entry{soup, 1, Value::of(Meal{false}), "cook"});
  EXPECT_FALSE(changes.is_complete());
  changes.note(Entry{soup, 2, Value::of(Meal{true}), "waiter"});
  EXPECT_TRUE(changes.is_complete());
  EXPECT_EQ(changes.begun(), 1U);
  changes.note(Entry{{"hall", "soup"}, 2, Value::of(Meal{false}), "waiter"});
  EXPECT_TRUE(changes.is_complete()) << "of another subarchitecture";
}

TEST_F(ExpectedChangesTest, DoNotMatterToEntriesThatNeverBegan) {
  changes.note(end, soup);
  EXPECT_TRUE(changes.is_complete());
  EXPECT_EQ(changes.begun(), 0U);
}

} // namespace

} // namespace castor::faults::test
