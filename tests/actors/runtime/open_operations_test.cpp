#include "castor/actors/runtime/open_operations.hpp"

#include <gtest/gtest.h>

namespace castor {

namespace {

using namespace std::chrono_literals;

struct OpenOperationsTest : testing::Test {
  static constexpr OpenOperations::TimePoint start{1h};

  std::uint64_t take() { return open.take_done()->id; }

  OpenOperations open;
};

TEST_F(OpenOperationsTest, AreCalledBackInTheOrderOfTheirResults) {
  open.begin({1, "", {}}, start);
  open.begin({2, "", {}}, start);
  open.begin_done({0, "", {}});
  EXPECT_EQ(take(), 0U);
  EXPECT_FALSE(open.has_done());
  EXPECT_FALSE(open.is_empty());
  open.answered(2);
  open.answered(1);
  EXPECT_EQ(take(), 2U);
  EXPECT_EQ(take(), 1U);
  EXPECT_TRUE(open.is_empty());
}

TEST_F(OpenOperationsTest, ThoseWithoutResultAreDoneWhenTheyAreDue) {
  open.begin({1, "", {}}, start + 1s);
  open.begin({2, "", {}}, start + 2s);
  open.begin({3, "", {}}, start + 3s);
  open.answered(1);
  EXPECT_EQ(take(), 1U);
  EXPECT_EQ(open.next_deadline(), start + 2s) << "who was answered is not due";
  open.expire(start + 2s);
  EXPECT_EQ(take(), 2U);
  EXPECT_FALSE(open.has_done());
  EXPECT_EQ(open.next_deadline(), start + 3s);
  open.answered(3);
  EXPECT_EQ(open.next_deadline(), OpenOperations::TimePoint::max());
}

TEST_F(OpenOperationsTest, AResultThatIsLateDoesNothing) {
  open.begin({1, "", {}}, start);
  open.expire(start);
  EXPECT_EQ(take(), 1U);
  open.answered(1);
  EXPECT_TRUE(open.is_empty());
}

} // namespace

} // namespace castor
