#include "castor/actors/runtime/pool_staff.hpp"

#include <gtest/gtest.h>

namespace castor {

namespace {

using namespace std::chrono_literals;

struct PoolStaffTest : testing::Test {
  PoolStaff::TimePoint now{1h};
  PoolStaff staff{{2, 100ms, 4}};
};

TEST_F(PoolStaffTest, AsManyAreHiredAsAreWanted) {
  EXPECT_EQ(staff.missing(now), 2U);
  staff.hire();
  EXPECT_EQ(staff.missing(now), 1U);
  staff.hire();
  EXPECT_EQ(staff.missing(now), 0U);
  EXPECT_FALSE(staff.has_surplus(now));
}

TEST_F(PoolStaffTest, WhoeverIsHeldUpIsReplacedUntilItIsBack) {
  auto first = staff.hire();
  staff.hire();
  staff.begin_turn(first, now);
  EXPECT_EQ(staff.missing(now + 99ms), 0U);
  EXPECT_EQ(staff.missing(now + 100ms), 1U);
  staff.hire();
  EXPECT_EQ(staff.missing(now + 1h), 0U);
  EXPECT_FALSE(staff.has_surplus(now + 1h));
  staff.end_turn(first);
  EXPECT_TRUE(staff.has_surplus(now + 1h));
  staff.dismiss(first);
  EXPECT_FALSE(staff.has_surplus(now + 1h));
}

TEST_F(PoolStaffTest, ThereIsALimit) {
  for (int i = 0; i < 4; ++i)
    staff.begin_turn(staff.hire(), now);
  EXPECT_EQ(staff.missing(now + 1h), 0U);
}

} // namespace

} // namespace castor
