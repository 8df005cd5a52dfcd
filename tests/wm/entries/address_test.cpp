#include "castor/wm/entries/address.hpp"

#include "castor/wm/values/value.hpp"

#include <gtest/gtest.h>

#include <unordered_set>

namespace castor::test {

TEST(Address, PrintsTheSubarchitectureBeforeTheId) {
  EXPECT_EQ(to_string(Address{"vision", "0:3"}), "vision/0:3");
}

TEST(Address, WithoutAnIdPrintsTheSubarchitectureAlone) {
  EXPECT_EQ(to_string(Address{"vision", ""}), "vision");
}

TEST(Address, OrdersBySubarchitectureThenId) {
  EXPECT_LT((Address{"a", "z"}), (Address{"b", "a"}));
  EXPECT_LT((Address{"a", "a"}), (Address{"a", "b"}));
  EXPECT_EQ((Address{"a", "b"}), (Address{"a", "b"}));
  EXPECT_NE((Address{"a", "b"}), (Address{"b", "a"}));
}

TEST(Address, HashesEqualAddressesAlikeAndSwappedOnesApart) {
  auto hash = std::hash<Address>{};
  EXPECT_EQ(hash({"a", "b"}), hash({"a", "b"}));
  EXPECT_NE(hash({"a", "b"}), hash({"b", "a"}));
  std::unordered_set<Address> set{{"a", "1"}, {"a", "2"}, {"b", "1"}, {"a", "1"}};
  EXPECT_EQ(set.size(), 3u);
}

TEST(Address, CanStandInAnEntry) {
  auto x = Value::of(Address{"vision", "0:3"});
  EXPECT_EQ(*decode_self_described(encode_self_described(x)).as<Address>(),
            (Address{"vision", "0:3"}));
}

} // namespace castor::test
