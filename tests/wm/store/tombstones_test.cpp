#include "castor/wm/store/tombstones.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace castor::test {

using ::testing::ElementsAre;
using ::testing::Pair;

namespace {

std::vector<std::pair<std::string, Version>> all(const Tombstones& x) {
  std::vector<std::pair<std::string, Version>> result;
  x.for_each([&](auto& id, Version version) { result.emplace_back(id, version); });
  return result;
}

} // namespace

TEST(Tombstones, VersionsGoOnWhereTheyEnded) {
  Tombstones x{10};
  EXPECT_EQ(x.version_for_add("a"), 0u);
  x.add("a", 4, 1);
  EXPECT_EQ(x.version("a"), 4u);
  EXPECT_EQ(x.version_for_add("a"), 5u);
  EXPECT_TRUE(x.erase("a"));
  EXPECT_FALSE(x.erase("a"));
  EXPECT_FALSE(x.version("a"));
}

TEST(Tombstones, TheLongestDeletedIsForgottenAndTheFloorRisesAboveIt) {
  Tombstones x{2};
  EXPECT_FALSE(x.add("a", 7, 1));
  EXPECT_FALSE(x.add("b", 3, 2));
  auto forgotten = x.add("c", 1, 3);
  ASSERT_TRUE(forgotten);
  EXPECT_EQ(forgotten->id, "a");
  EXPECT_EQ(forgotten->sequence, 1u);
  EXPECT_THAT(all(x), ElementsAre(Pair("b", 3u), Pair("c", 1u)));
  EXPECT_EQ(x.floor(), 8u);
  EXPECT_EQ(x.version_for_add("a"), 8u);
  EXPECT_EQ(x.version_for_add("b"), 4u);
}

TEST(Tombstones, WithoutRoomOnlyTheFloorRemembers) {
  Tombstones x{0, 100};
  EXPECT_TRUE(x.add("a", 200, 1));
  EXPECT_EQ(x.size(), 0u);
  EXPECT_EQ(x.version_for_add("a"), 201u);
}

TEST(Tombstones, AnIdThatIsDeletedAgainCountsAsTheLast) {
  Tombstones x{2};
  x.add("a", 1, 1);
  x.add("b", 1, 2);
  x.add("a", 3, 3);
  EXPECT_THAT(all(x), ElementsAre(Pair("b", 1u), Pair("a", 3u)));
}

TEST(Tombstones, ANewIncarnationRaisesTheVersionsOfEarlierDeletions) {
  Tombstones x{2};
  x.add("a", 1, 1);
  x.begin_incarnation(1000);
  EXPECT_EQ(x.version("a"), 1000u);
  EXPECT_EQ(x.floor(), 1000u);
  x.add("b", 5, 1001);
  EXPECT_EQ(x.version("b"), 5u) << "that one was deleted in this incarnation";
  x.add("c", 5, 1002);
  EXPECT_EQ(x.floor(), 1001u) << "above the version of a as it counts now";
}

} // namespace castor::test
