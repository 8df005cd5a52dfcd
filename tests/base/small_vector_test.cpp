#include "castor/base/small_vector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace castor {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Texts = SmallVector<std::string, 2>;

TEST(SmallVector, GrowsBeyondTheElementsThatItHasRoomFor) {
  Texts x;
  EXPECT_THAT(x, IsEmpty());
  x.push_back("a");
  x.push_back("b");
  EXPECT_THAT(x, ElementsAre("a", "b"));
  x.push_back("c");
  x.push_back("d");
  EXPECT_THAT(x, ElementsAre("a", "b", "c", "d"));
  EXPECT_EQ(x.front(), "a");
  EXPECT_EQ(x.back(), "d");
  EXPECT_EQ(x[2], "c");
}

TEST(SmallVector, IsCopiedAndMoved) {
  for (auto& x : {Texts{}, Texts{"a"}, Texts{"a", "b", "c"}}) {
    auto copy = x;
    EXPECT_EQ(copy, x);
    auto moved = std::move(copy);
    EXPECT_EQ(moved, x);
    EXPECT_THAT(copy, IsEmpty()); // NOLINT(bugprone-use-after-move)
    copy.push_back("z");
    EXPECT_THAT(copy, ElementsAre("z"));
    moved = copy;
    EXPECT_EQ(moved, copy);
    moved = Texts{"1", "2", "3"};
    EXPECT_EQ(moved.size(), 3u);
  }
}

TEST(SmallVector, ElementsCanBeErased) {
  for (auto text : {"ab", "abcabc", "b", ""}) {
    Texts x;
    std::string rest;
    for (auto c : std::string{text}) {
      x.push_back({c});
      if (c != 'b')
        rest += c;
    }
    auto count = x.size();
    EXPECT_EQ(erase(x, std::string{"b"}), count - rest.size());
    ASSERT_EQ(x.size(), rest.size());
    for (std::size_t i = 0; i < rest.size(); ++i)
      EXPECT_EQ(x[i], std::string(1, rest[i]));
    x.push_back("new");
    EXPECT_EQ(x.back(), "new");
    x.erase(x.begin());
    EXPECT_EQ(x.size(), rest.size());
    x.clear();
    EXPECT_TRUE(x.empty());
  }
}

TEST(SmallVector, KeepsNothingOfWhatWasErased) {
  SmallVector<std::shared_ptr<int>, 2> x{std::make_shared<int>(1), std::make_shared<int>(2)};
  std::weak_ptr<int> first = x[0], second = x[1];
  x.erase(x.begin());
  EXPECT_TRUE(first.expired());
  x.clear();
  EXPECT_TRUE(second.expired());
}

} // namespace

} // namespace castor
