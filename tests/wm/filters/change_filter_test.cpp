#include "castor/wm/filters/change_filter.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
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

/// Whether a filter wants an event as far as it can tell without the content.
bool matches(const ChangeFilter& filter, const ChangeEvent& x) {
  return castor::matches(filter, x, Value{});
}

bool matches(const ChangeFilter& filter, const SignedBox& content) {
  return castor::matches(filter.anywhere(), event(), Value::of(content));
}

template <class Filter, class Condition>
concept TakesCondition = requires(const Filter& filter, const Condition& condition) {
  filter.where(condition);
};

template <class Filter, class Member, class V>
concept TakesEquality = requires(const Filter& filter, Member member, const V& value) {
  filter.where(member, value);
};

template <class Filter, class Member>
concept TakesChanging = requires(const Filter& filter, Member member) {
  filter.changing(member);
};

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

TEST(ChangeFilter, WantsTheContentThatItAsksFor) {
  auto filter = changed<SignedBox>().where(field(&SignedBox::side) == Side::right);
  EXPECT_TRUE(matches(filter, signed_box()));
  auto other = signed_box();
  other.side = Side::left;
  EXPECT_FALSE(matches(filter, other));
  EXPECT_TRUE(matches(changed<SignedBox>().where(&SignedBox::label, "tea"), signed_box()));
  EXPECT_FALSE(matches(changed<SignedBox>().where(&SignedBox::label, "coffee"), signed_box()));
  EXPECT_TRUE(matches(changed<SignedBox>().where("pose.heading > 2"), signed_box()));
  EXPECT_TRUE(matches(any_change().where("pose.heading > 2"), signed_box()));
  EXPECT_FALSE(matches(any_change().where("pose.heading > 4"), signed_box()));
}

TEST(ChangeFilter, NeedsAllOfItsConditions) {
  auto filter = changed<SignedBox>().where(&SignedBox::label, "tea").where("pose.heading > 2");
  EXPECT_EQ(filter.predicate.text(), "label == \"tea\" && pose.heading > 2");
}

TEST(ChangeFilter, DoesNotWantATypeThatLacksTheField) {
  EXPECT_FALSE(matches(any_change().where("confidence > 2"), signed_box()));
  EXPECT_FALSE(matches(any_change().where("!(confidence > 2)"), signed_box()));
}

TEST(ChangeFilter, WithAConditionWantsNothingWithoutContent) {
  EXPECT_FALSE(matches(changed<SignedBox>().anywhere().where("label != \"x\""), event()));
}

TEST(ChangeFilter, TakesOnlyConditionsOnItsTypeOrABaseOfIt) {
  using Signed = ChangeFilterOf<SignedBox>;
  static_assert(TakesCondition<Signed, PredicateOf<SignedBox>>);
  static_assert(TakesCondition<Signed, PredicateOf<Box>>);
  static_assert(!TakesCondition<ChangeFilterOf<Box>, PredicateOf<SignedBox>>);
  static_assert(!TakesCondition<Signed, PredicateOf<Pose>>);
  static_assert(!TakesCondition<Signed, Predicate>);
  static_assert(TakesCondition<ChangeFilter, Predicate>);
  static_assert(TakesCondition<ChangeFilterOf<Numbers>, Field<Numbers, bool>>);
  static_assert(!TakesCondition<ChangeFilterOf<Numbers>, Field<Numbers, double>>);
  static_assert(TakesEquality<Signed, Side SignedBox::*, Side>);
  static_assert(TakesEquality<Signed, std::string Box::*, const char*>);
  static_assert(!TakesEquality<Signed, Side SignedBox::*, Trend>);
  static_assert(!TakesEquality<Signed, std::string Box::*, int>);
  static_assert(!TakesEquality<ChangeFilterOf<Box>, Side SignedBox::*, Side>);
  static_assert(TakesChanging<Signed, std::string Box::*>);
  static_assert(!TakesChanging<ChangeFilterOf<Box>, Side SignedBox::*>);
}

TEST(ChangeFilter, ChecksATextAgainstItsTypeAtOnce) {
  EXPECT_THROW(changed<Box>().where("colour == 3"), FieldError);
  EXPECT_THROW(changed<Box>().where("label == 3"), FieldError);
  EXPECT_THROW(changed<Box>().where("label =="), PredicateError);
  EXPECT_THROW(any_change().where("label =="), PredicateError);
  EXPECT_NO_THROW(changed<SignedBox>().where("label == \"a\" && side == \"left\""));
}

TEST(ChangeFilter, WantsOverwritesThatChangedOneOfItsFields) {
  auto x = event();
  x.changed = field_bit(*x.type, "pose") | field_bit(*x.type, "side");
  EXPECT_TRUE(matches(changed(&Box::pose).anywhere(), x));
  EXPECT_TRUE(matches(changed(&SignedBox::side).anywhere(), x));
  EXPECT_TRUE(matches(changed(&SignedBox::side, &Box::label).anywhere(), x));
  EXPECT_FALSE(matches(changed(&Box::label).anywhere(), x));
  EXPECT_FALSE(matches(changed(&SignedBox::signature, &Box::label).anywhere(), x));
  x.changed = 0;
  EXPECT_FALSE(matches(changed(&Box::pose).anywhere(), x));
}

TEST(ChangeFilter, ThatWaitsForChangedFieldsWantsOnlyOverwrites) {
  auto filter = changed<Box>().changing(&Box::pose).anywhere();
  auto x = event();
  x.changed = all_fields(*x.type);
  EXPECT_TRUE(matches(filter, x));
  for (auto operation : {Operation::add, Operation::remove}) {
    x.operation = operation;
    EXPECT_FALSE(matches(filter, x));
  }
}

TEST(ChangeFilter, NamesItsFieldsInOneOrder) {
  auto filter = changed(&SignedBox::side, &Box::pose).changing(&Box::label, &Box::pose);
  EXPECT_THAT(filter.ChangeFilter::changing, testing::ElementsAre("label", "pose", "side"));
  EXPECT_EQ(filter.operation, Operation::overwrite);
  EXPECT_EQ(filter.type, "SignedBox");
  EXPECT_EQ(changed(&Box::pose, &Box::label), changed(&Box::label, &Box::pose));
}

TEST(ChangeFilter, KeepsItsTypeWhenRefined) {
  static_assert(std::is_same_v<decltype(added<Box>().anywhere().in("a").from("c").at({"a", "b"})),
                               ChangeFilterOf<Box>>);
  auto filter = added<Box>().at({"a", "b"}).from("c").where(&Box::label, "x");
  EXPECT_EQ(filter.operation, Operation::add);
  EXPECT_EQ(filter.type, "Box");
  EXPECT_EQ(filter.id, "b");
  EXPECT_EQ(filter.source, "c");
  EXPECT_EQ(filter.subarchitecture, "a");
  EXPECT_EQ(filter.anywhere().predicate, Predicate::parse("label == \"x\""));
}

TEST(ChangeFilter, IsOrderedByItsWishesForContent) {
  EXPECT_NE(any_change(), any_change().where("a == 1"));
  EXPECT_NE(any_change().where("a == 2"), any_change().where("a == 1"));
  EXPECT_EQ(any_change().where("a==1"), any_change().where("a == 1"));
  EXPECT_NE(overwritten<Box>(), changed(&Box::label));
}

TEST(ChangeFilter, PrintsItsWishesForContent) {
  EXPECT_EQ(to_string(changed(&Box::pose, &Box::label).where(&Box::label, "x").anywhere()),
            "OVERWRITE of Box anywhere, changing label or pose, where label == \"x\"");
}

} // namespace castor::test
