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

TEST(AccessRules, LetEverybodyReadByDefault) {
  AccessRules rules{"vision"};
  EXPECT_TRUE(rules.may_read("planning"));
}

TEST(AccessRules, LetOnlyThoseReadWhoWereNamed) {
  AccessRules rules{"vision"};
  rules.set_readers({{"spatial"}});
  EXPECT_TRUE(rules.may_read("spatial"));
  EXPECT_TRUE(rules.may_read("vision"));
  EXPECT_FALSE(rules.may_read("planning"));
  EXPECT_TRUE(rules.may_read("operator")) << "people look into everything";
  EXPECT_TRUE(rules.may_read("")) << "the runtime itself";
  EXPECT_EQ(
    rules.readers_text("planning"),
    "only components of vision and of spatial read there, since the system's .cast file has "
    "rules ACCESS reader READS vision. To allow it, add ACCESS planning READS vision");
  rules.set_readers({{"*"}});
  EXPECT_TRUE(rules.may_read("planning"));
}

} // namespace castor::test
