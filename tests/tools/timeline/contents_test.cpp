#include "castor/tests/tools/timeline/support.hpp"

#include <gmock/gmock.h>

namespace castor::timeline::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(TimelineContents, AddressesTextsAndPicturesAreFoundAtWhateverDepth) {
  Sight sight;
  sight.views = {image(4, 2), image(3, 3, 1)};
  sight.of.address = {"vision", "0:1"};
  sight.numbers = {1, 2};
  auto value = Value::of(sight);
  auto found = contents_of(value);
  EXPECT_THAT(found.addresses, ElementsAre(Address{"vision", "0:1"}));
  EXPECT_THAT(found.texts, IsEmpty()) << "what stands in an address is no text";
  ASSERT_EQ(found.pictures.size(), 2u);
  EXPECT_EQ(found.pictures[0].width, 4u);
  EXPECT_EQ(found.pictures[1].channels, 1u);
  EXPECT_EQ(found.pictures[1].bytes.size(), 9u);
}

TEST(TimelineContents, TextsAreThereOnceAndNeverEmpty) {
  auto value = Value::of(Note{"b", {"a", "", "b"}});
  EXPECT_THAT(contents_of(value).texts, ElementsAre("a", "b"));
}

TEST(TimelineContents, PicturesWhoseNumbersContradictEachOtherAreNone) {
  auto wrong = image(4, 4);
  wrong.width = 5;
  auto huge = image(1, 1);
  huge.width = huge.height = 0xffffffff;
  EXPECT_THAT(contents_of(Value::of(Sight{{wrong, huge, image(2, 2, 4)}, {}, {}})).pictures,
              IsEmpty());
}

TEST(TimelineContents, OfADamagedValueSomeIsBetterThanNothing) {
  auto bytes = encode(Note{"text", {"more"}});
  bytes.resize(bytes.size() - 2);
  auto damaged = Value::from_bytes(descriptor_of<Note>(), bytes);
  EXPECT_THAT(contents_of(damaged).texts, ElementsAre("text"));
  EXPECT_THAT(contents_of(Value{}).texts, IsEmpty());
}

} // namespace

} // namespace castor::timeline::test
