#include "castor/wm/change_filter.hpp"

#include "test_types.hpp"

#include <gtest/gtest.h>

namespace castor::test {

namespace {

/// A signed box of the vision subarchitecture was overwritten by the tracker.
ChangeEvent event() {
  ChangeEvent result;
  result.operation = Operation::overwrite;
  result.address = {"vision", "0:3"};
  result.source = "tracker";
  result.type = descriptor_of<SignedBox>();
  return result;
}

} // namespace

TEST(ChangeFilter, WithoutWishesWantsEverything) {
  EXPECT_TRUE(matches(any_change().anywhere(), event()));
}

TEST(ChangeFilter, WantsNothingUntilItsSubarchitectureIsResolved) {
  EXPECT_FALSE(matches(any_change(), event()));
  EXPECT_FALSE(matches(overwritten<SignedBox>(), event()));
  EXPECT_TRUE(matches(overwritten<SignedBox>().in("vision"), event()));
}

TEST(ChangeFilter, TellsOperationsApart) {
  EXPECT_TRUE(matches(overwritten<SignedBox>().anywhere(), event()));
  EXPECT_TRUE(matches(changed<SignedBox>().anywhere(), event()));
  EXPECT_FALSE(matches(added<SignedBox>().anywhere(), event()));
  EXPECT_FALSE(matches(deleted<SignedBox>().anywhere(), event()));
}

TEST(ChangeFilter, WantsSuperTypesButNotOtherTypes) {
  EXPECT_TRUE(matches(changed<PaintedBox>().anywhere(), event()));
  EXPECT_TRUE(matches(changed<Box>().anywhere(), event()));
  EXPECT_FALSE(matches(changed<Crate>().anywhere(), event()));
  EXPECT_FALSE(matches(changed<Pose>().anywhere(), event()));
}

TEST(ChangeFilter, OfADerivedTypeDoesNotWantTheBase) {
  auto x = event();
  x.type = descriptor_of<Box>();
  EXPECT_FALSE(matches(changed<SignedBox>().anywhere(), x));
}

TEST(ChangeFilter, TellsSubarchitecturesApart) {
  EXPECT_TRUE(matches(any_change().in("vision"), event()));
  EXPECT_FALSE(matches(any_change().in("spatial"), event()));
}

TEST(ChangeFilter, TellsSourcesApart) {
  EXPECT_TRUE(matches(any_change().anywhere().from("tracker"), event()));
  EXPECT_FALSE(matches(any_change().anywhere().from("segmentor"), event()));
}

TEST(ChangeFilter, TellsEntriesApart) {
  EXPECT_TRUE(matches(changes_of({"vision", "0:3"}), event()));
  EXPECT_FALSE(matches(changes_of({"vision", "0:4"}), event()));
  EXPECT_FALSE(matches(changes_of({"spatial", "0:3"}), event()));
  EXPECT_TRUE(matches(deleted<Box>().at({"vision", "0:3"}), [] {
    auto x = event();
    x.operation = Operation::remove;
    return x;
  }()));
}

TEST(ChangeFilter, NeedsAgreementInEveryFieldThatIsSet) {
  auto all = overwritten<Box>().at({"vision", "0:3"}).from("tracker");
  EXPECT_TRUE(matches(all, event()));
  auto one_off = [&](auto change) {
    auto x = all;
    change(x);
    return matches(x, event());
  };
  EXPECT_FALSE(one_off([](auto& x) { x.operation = Operation::add; }));
  EXPECT_FALSE(one_off([](auto& x) { x.type = "Other"; }));
  EXPECT_FALSE(one_off([](auto& x) { x.id = "0:4"; }));
  EXPECT_FALSE(one_off([](auto& x) { x.source = "other"; }));
  EXPECT_FALSE(one_off([](auto& x) { x.subarchitecture = "other"; }));
  EXPECT_FALSE(one_off([](auto& x) { x.subarchitecture.reset(); }));
}

TEST(ChangeFilter, IsRefinedWithoutChangingTheOriginal) {
  auto original = changed<Box>();
  auto refined = original.in("vision").from("tracker");
  EXPECT_EQ(original, changed<Box>());
  EXPECT_NE(original, refined);
  EXPECT_EQ(refined.subarchitecture, "vision");
  EXPECT_EQ(refined.anywhere().subarchitecture, "");
}

TEST(ChangeFilter, IsOrderedByAllItsFields) {
  EXPECT_NE(any_change(), any_change().anywhere());
  EXPECT_NE(added<Box>(), deleted<Box>());
  EXPECT_NE(added<Box>(), added<Pose>());
  EXPECT_EQ(added<Box>().in("a") < added<Box>().in("b"), true);
}

TEST(ChangeFilter, PrintsWhatItWants) {
  EXPECT_EQ(to_string(any_change()), "any change of any type in the own subarchitecture");
  EXPECT_EQ(to_string(overwritten<Box>().in("vision").from("tracker")),
            "OVERWRITE of Box in vision by tracker");
  EXPECT_EQ(to_string(deleted<Box>().anywhere()), "DELETE of Box anywhere");
  EXPECT_EQ(to_string(changes_of({"vision", "0:3"})),
            "any change of any type with id 0:3 in vision");
}

} // namespace castor::test
