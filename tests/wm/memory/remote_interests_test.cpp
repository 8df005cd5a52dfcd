#include "castor/wm/memory/remote_interests.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace castor::test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

namespace {

std::vector<FilterIndex::Key> subscribers(const RemoteInterests& interests, InterestId id) {
  std::vector<FilterIndex::Key> result;
  interests.append_subscribers(id, result);
  return result;
}

} // namespace

TEST(RemoteInterests, AreSharedByEqualFilters) {
  RemoteInterests interests{0};
  auto one = interests.add(any_change().in("b"), 1);
  auto other = interests.add(any_change().in("c"), 2);
  EXPECT_EQ(interests.add(any_change().in("b"), 3), one);
  EXPECT_NE(one, other);
  EXPECT_THAT(subscribers(interests, one), ElementsAre(1u, 3u));
  EXPECT_THAT(subscribers(interests, other), ElementsAre(2u));
}

TEST(RemoteInterests, EndWithTheLastSubscriber) {
  RemoteInterests interests{0};
  auto filter = any_change().anywhere();
  auto id = interests.add(filter, 1);
  interests.add(filter, 2);
  EXPECT_FALSE(interests.remove(filter, 1));
  EXPECT_EQ(interests.remove(filter, 2), id);
  EXPECT_FALSE(interests.remove(filter, 2));
  EXPECT_THAT(subscribers(interests, id), IsEmpty());
  EXPECT_NE(interests.add(filter, 1), id) << "events for the former may be on their way";
}

TEST(RemoteInterests, AreNumberedFromAboveThoseOfAFormerLife) {
  RemoteInterests interests{100};
  EXPECT_EQ(interests.add(any_change().in("b"), 1), 101u);
}

} // namespace castor::test
