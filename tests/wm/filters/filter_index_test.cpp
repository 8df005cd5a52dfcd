#include "castor/wm/filters/filter_index.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

ChangeEvent addition() {
  ChangeEvent result;
  result.operation = Operation::add;
  result.address = {"vision", "0:3"};
  result.source = "tracker";
  result.type = descriptor_of<SignedBox>();
  return result;
}

std::vector<FilterIndex::Key> found(FilterIndex& index, const ChangeEvent& x = addition(),
                                    const Value& content = Value::of(signed_box())) {
  std::vector<FilterIndex::Key> result;
  index.match(x, content, result);
  return result;
}

std::vector<FilterIndex::Key> found(FilterIndex& index, const SignedBox& content) {
  return found(index, addition(), Value::of(content));
}

ChangeEvent overwriting(std::initializer_list<std::string_view> fields) {
  auto result = addition();
  result.operation = Operation::overwrite;
  for (auto name : fields)
    result.changed |= field_bit(*result.type, name);
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
  auto x = addition();
  x.operation = Operation::remove;
  expect_only_without(1, x);
  x = addition();
  x.address.id = "0:4";
  expect_only_without(2, x);
  x = addition();
  x.source = "segmentor";
  expect_only_without(4, x);
  x = addition();
  x.address.subarchitecture = "spatial";
  expect_only_without(8, x);
  x = addition();
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
  index.match(addition(), Value{}, keys);
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

TEST(FilterIndex, FindsFiltersByEquality) {
  FilterIndex index;
  index.insert(1, any_change().anywhere().where("label == \"tea\""));
  index.insert(2, any_change().anywhere().where("label == \"coffee\""));
  index.insert(3, any_change().anywhere().where("pose.heading == 3"));
  index.insert(4, any_change().anywhere().where("side == \"right\" && label == \"coffee\""));
  index.insert(5, any_change().anywhere().where("side == \"right\" && label == \"tea\""));
  index.insert(6, changed<Box>().anywhere().where("label == \"tea\""));
  EXPECT_THAT(found(index), UnorderedElementsAre(1, 3, 5, 6));
}

TEST(FilterIndex, TellsTheEndsOfRangesApart) {
  FilterIndex index;
  index.insert(1, any_change().anywhere().where("pose.heading > 3"));
  index.insert(2, any_change().anywhere().where("pose.heading >= 3"));
  index.insert(3, any_change().anywhere().where("pose.heading < 3"));
  index.insert(4, any_change().anywhere().where("pose.heading <= 3"));
  index.insert(5, any_change().anywhere().where("pose.heading > 2.5"));
  index.insert(6, any_change().anywhere().where("pose.heading < 3.5"));
  index.insert(7, any_change().anywhere().where("pose.heading < 2.5"));
  index.insert(8, any_change().anywhere().where("pose.heading > 3.5"));
  EXPECT_THAT(found(index), UnorderedElementsAre(2, 4, 5, 6));
  auto box = signed_box();
  box.pose.heading = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(found(index, box), IsEmpty());
  box.pose.heading = std::numeric_limits<double>::infinity();
  EXPECT_THAT(found(index, box), UnorderedElementsAre(1, 2, 5, 8));
}

TEST(FilterIndex, FindsRangesWithTwoEnds) {
  FilterIndex index;
  for (FilterIndex::Key i = 0; i < 100; ++i) {
    auto low = std::to_string(i);
    auto high = std::to_string(i + 1);
    index.insert(
      i, any_change().anywhere().where("pose.heading >= " + low + " && pose.heading < " + high));
  }
  index.insert(1000, any_change().anywhere().where("pose.heading > -1e9 && pose.heading < 1e9"));
  index.insert(1001, any_change().anywhere().where("pose.heading >= 3 && pose.heading <= 3"));
  index.insert(1002, any_change().anywhere().where("pose.heading > 4 && pose.heading < 2"));
  index.insert(1003,
               any_change().anywhere().where("pose.heading > -1e999 && pose.heading < 1e999"));
  index.insert(1004,
               any_change().anywhere().where("pose.heading > -1.7e308 && pose.heading < 1.7e308"));
  EXPECT_THAT(found(index), UnorderedElementsAre(3, 1000, 1001, 1003, 1004));
}

TEST(FilterIndex, ErasesRangesThatNothingCanLieIn) {
  FilterIndex index;
  auto never = any_change().anywhere().where("pose.heading > 4 && pose.heading < 2");
  auto always = any_change().anywhere().where("pose.heading == 3");
  index.insert(1, never);
  index.insert(2, always);
  EXPECT_TRUE(index.erase(2, always));
  EXPECT_TRUE(index.erase(1, never));
  EXPECT_THAT(found(index), IsEmpty());
}

TEST(FilterIndex, FindsNeighbourhoods) {
  // The box lies at (1.5, -2.25, 0.5).
  FilterIndex index;
  auto near = [](const std::string& point, const std::string& radius) {
    return any_change().anywhere().where("distance(pose.position, " + point + ") < " + radius);
  };
  index.insert(1, near("[1.5, -2.25, 0.5]", "0.001"));
  index.insert(2, near("[1.5, -2.25, 0]", "0.4"));
  index.insert(3, near("[1.5, -2.25, 0]", "0.6"));
  index.insert(4, near("[100, 0, 0]", "200"));
  index.insert(5, near("[1, -2]", "10"));
  index.insert(6, near("[1.5, -2.25, 0.5]", "0"));
  index.insert(7, near("[0, 0, 0]", "1e999"));
  index.insert(8, any_change().anywhere().where("distance([1.5, -2.25, 0.5], pose.position) <= 0"));
  index.insert(9, any_change().anywhere().where("2 >= distance(pose.position, [1.5, -2.25, 2])"));
  index.insert(10, any_change().anywhere().where("distance(pose.position, [1.5, -2.25, 2]) > 2"));
  EXPECT_THAT(found(index), UnorderedElementsAre(1, 3, 4, 7, 8, 9));
}

TEST(FilterIndex, FindsFiltersThatCanOnlyBeTried) {
  FilterIndex index;
  index.insert(1, any_change().anywhere().where("label != \"coffee\""));
  index.insert(2, any_change().anywhere().where("label == \"tea\" || label == \"coffee\""));
  index.insert(3, any_change().anywhere().where("!has(signature)"));
  index.insert(4, any_change().anywhere().where("pose.position.x > pose.position.y"));
  EXPECT_THAT(found(index), UnorderedElementsAre(1, 2, 4));
}

TEST(FilterIndex, FindsFiltersByChangedFieldsOnceEach) {
  FilterIndex index;
  index.insert(1, changed(&Box::label).anywhere());
  index.insert(2, changed(&Box::label, &Box::pose).anywhere());
  index.insert(3, changed(&SignedBox::side).anywhere());
  index.insert(4, changed(&Box::label).anywhere().where(&Box::label, "tea"));
  index.insert(5, changed(&Box::label).anywhere().where(&Box::label, "coffee"));
  index.insert(6, changed(&Box::pose).anywhere().where("label != \"coffee\""));
  EXPECT_THAT(found(index, overwriting({"label"})), UnorderedElementsAre(1, 2, 4));
  EXPECT_THAT(found(index, overwriting({"label", "pose"})), UnorderedElementsAre(1, 2, 4, 6));
  EXPECT_THAT(found(index, overwriting({"side"})), UnorderedElementsAre(3));
  EXPECT_THAT(found(index, overwriting({})), IsEmpty());
  EXPECT_THAT(found(index, addition()), IsEmpty());
}

TEST(FilterIndex, SaysWhenChangedFieldsMatter) {
  FilterIndex index;
  EXPECT_FALSE(index.wants_changed_fields(overwriting({})));
  index.insert(1, overwritten<Box>().anywhere());
  index.insert(2, changed(&Pose::heading).anywhere());
  index.insert(3, changed(&Box::label).in("spatial"));
  EXPECT_FALSE(index.wants_changed_fields(overwriting({})));
  auto filter = changed(&Box::label).in("vision").where(&Box::label, "tea");
  index.insert(4, filter);
  EXPECT_TRUE(index.wants_changed_fields(overwriting({})));
  EXPECT_FALSE(index.wants_changed_fields(addition()));
  index.erase(4, filter);
  EXPECT_FALSE(index.wants_changed_fields(overwriting({})));
}

TEST(FilterIndex, LooksAtNoContentThatIsNotThere) {
  FilterIndex index;
  index.insert(1, any_change().anywhere().where("label == \"tea\""));
  index.insert(2, any_change().anywhere().where("label != \"coffee\""));
  index.insert(3, any_change().anywhere());
  EXPECT_THAT(found(index, addition(), Value{}), ElementsAre(3));
}

TEST(FilterIndex, FindsNothingInBytesThatAreNoValue) {
  FilterIndex index;
  index.insert(1, any_change().anywhere().where("signature == \"Nick\""));
  index.insert(2, any_change().anywhere().where("signature != \"Ann\""));
  index.insert(3, any_change().anywhere().where("distance(pose.position, [0, 0, 0]) < 100"));
  index.insert(4, any_change().anywhere());
  auto bytes = Value::of(signed_box()).bytes();
  auto type = descriptor_of<SignedBox>();
  EXPECT_THAT(found(index, addition(), Value::from_bytes(type, bytes)),
              UnorderedElementsAre(1, 2, 3, 4));
  EXPECT_THAT(found(index, addition(), Value::from_bytes(type, {1, 2, 3})), ElementsAre(4));
}

} // namespace castor::test
