#include "castor/wm/store/access_rules.hpp"

#include <gtest/gtest.h>

namespace castor::test {

TEST(AccessRules, LetOnlyTheOwnSubarchitectureWriteByDefault) {
  AccessRules rules{"vision"};
  EXPECT_TRUE(rules.may_write("vision"));
  EXPECT_FALSE(rules.may_write("spatial"));
  EXPECT_FALSE(rules.may_write(""));
}

TEST(AccessRules, LetThoseWriteWhoWereNamed) {
  AccessRules rules{"vision"};
  rules.allow("spatial");
  EXPECT_TRUE(rules.may_write("spatial"));
  EXPECT_TRUE(rules.may_write("vision"));
  EXPECT_FALSE(rules.may_write("planning"));
}

TEST(AccessRules, LetEverybodyWriteWhereOpened) {
  AccessRules rules{"vision"};
  rules.allow_all();
  EXPECT_TRUE(rules.may_write("vision"));
  EXPECT_TRUE(rules.may_write("planning"));
  EXPECT_TRUE(rules.may_write(""));
}

} // namespace castor::test
