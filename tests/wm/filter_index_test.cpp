#include "castor/wm/filter_index.hpp"

#include "test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

ChangeEvent event() {
  ChangeEvent result;
  result.operation = Operation::add;
  result.address = {"vision", "0:3"};
  result.source = "tracker";
  result.type = descriptor_of<SignedBox>();
  return result;
}

std::vector<FilterIndex::Key> found(const FilterIndex& index, const ChangeEvent& x = event()) {
  std::vector<FilterIndex::Key> result;
  index.match(x, result);
  return result;
}

} // namespace

TEST(FilterIndex, FindsNothingWhenEmpty) {
  FilterIndex index;
  EXPECT_EQ(index.size(), 0u);
  EXPECT_THAT(found(index), IsEmpty());
}

TEST(FilterIndex, FindsFiltersOfEveryShape) {
  // Every set of the five fields, each set to what the event has: all 32 want it, and with one
  // field of the event changed only those that do not ask for it.
  FilterIndex index;
  for (FilterIndex::Key shape = 0; shape < 32; ++shape) {
    auto filter = any_change().anywhere();
    if (shape & 1)
      filter.operation = Operation::add;
    if (shape & 2)
      filter.id = "0:3";
    if (shape & 4)
      filter.source = "tracker";
    if (shape & 8)
      filter.subarchitecture = "vision";
    if (shape & 16)
      filter.type = "PaintedBox";
    index.insert(shape, filter);
  }
  EXPECT_EQ(index.size(), 32u);
  EXPECT_EQ(found(index).size(), 32u);
  auto expect_only_without = [&](FilterIndex::Key bit, const ChangeEvent& x) {
    auto keys = found(index, x);
    EXPECT_EQ(keys.size(), 16u);
    for (auto key : keys)
      EXPECT_EQ(key & bit, 0u);
  };
  auto x = event();
  x.operation = Operation::remove;
  expect_only_without(1, x);
  x = event();
  x.address.id = "0:4";
  expect_only_without(2, x);
  x = event();
  x.source = "segmentor";
  expect_only_without(4, x);
  x = event();
  x.address.subarchitecture = "spatial";
  expect_only_without(8, x);
  x = event();
  x.type = descriptor_of<Box>();
  expect_only_without(16, x);
}

TEST(FilterIndex, FindsSuperTypesOnceEach) {
  FilterIndex index;
  index.insert(1, changed<SignedBox>().anywhere());
  index.insert(2, changed<PaintedBox>().anywhere());
  index.insert(3, changed<Box>().anywhere());
  index.insert(4, changed<Crate>().anywhere());
  EXPECT_THAT(found(index), UnorderedElementsAre(1, 2, 3));
}

TEST(FilterIndex, FindsOneKeyOnceForEachOfItsFilters) {
  FilterIndex index;
  index.insert(7, any_change().anywhere());
  index.insert(7, any_change().in("vision"));
  index.insert(7, any_change().in("spatial"));
  EXPECT_THAT(found(index), ElementsAre(7, 7));
}

TEST(FilterIndex, FindsAPairThatWasInsertedTwiceTwice) {
  FilterIndex index;
  index.insert(7, any_change().anywhere());
  index.insert(7, any_change().anywhere());
  EXPECT_THAT(found(index), ElementsAre(7, 7));
  EXPECT_TRUE(index.erase(7, any_change().anywhere()));
  EXPECT_THAT(found(index), ElementsAre(7));
}

TEST(FilterIndex, AppendsToWhatWasFoundBefore) {
  FilterIndex index;
  index.insert(7, any_change().anywhere());
  std::vector<FilterIndex::Key> keys{1};
  index.match(event(), keys);
  EXPECT_THAT(keys, ElementsAre(1, 7));
}

TEST(FilterIndex, ErasesExactlyThePair) {
  FilterIndex index;
  index.insert(1, changed<Box>().anywhere());
  index.insert(2, changed<Box>().anywhere());
  index.insert(1, changed<Box>().in("vision"));
  EXPECT_TRUE(index.erase(1, changed<Box>().anywhere()));
  EXPECT_EQ(index.size(), 2u);
  EXPECT_THAT(found(index), UnorderedElementsAre(2, 1));
}

TEST(FilterIndex, SaysWhenThereIsNoSuchPair) {
  FilterIndex index;
  index.insert(1, changed<Box>().anywhere());
  EXPECT_FALSE(index.erase(2, changed<Box>().anywhere()));
  EXPECT_FALSE(index.erase(1, changed<Box>().in("vision")));
  EXPECT_FALSE(index.erase(1, changed<PaintedBox>().anywhere()));
  EXPECT_TRUE(index.erase(1, changed<Box>().anywhere()));
  EXPECT_FALSE(index.erase(1, changed<Box>().anywhere()));
  EXPECT_EQ(index.size(), 0u);
}

TEST(FilterIndex, NeverFindsAFilterThatWasNotResolved) {
  FilterIndex index;
  index.insert(1, any_change());
  EXPECT_THAT(found(index), IsEmpty());
  EXPECT_TRUE(index.erase(1, any_change()));
}

} // namespace castor::test
