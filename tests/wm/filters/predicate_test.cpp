#include "castor/wm/filters/predicate.hpp"

#include "castor/tests/wm/filters/random_predicates.hpp"
#include "castor/wm/filters/predicate_tree.hpp"
#include "castor/wm/values/value.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace castor::test {

namespace {

using testing::HasSubstr;
using testing::Throws;

bool is_true(std::string_view text, const Thing& x = {}) {
  auto predicate = Predicate::parse(text);
  bool result = predicate.matches(Value::of(x));
  EXPECT_EQ(predicate.matches(Value::from_bytes(descriptor_of<Thing>(), encode(x))), result);
  return result;
}

std::string type_complaint(std::string_view text,
                           const TypeDescriptor& type = *descriptor_of<Thing>()) {
  try {
    Predicate::parse(text).check(type);
  } catch (const FieldError& e) {
    return e.what();
  }
  return "no type_complaint";
}

} // namespace

TEST(Predicate, IsTrueOfEverythingWhenEmpty) {
  EXPECT_TRUE(Predicate{}.empty());
  EXPECT_TRUE(Predicate{}.matches(Value::of(Thing{})));
  EXPECT_EQ(type_complaint(""), "no type_complaint");
  EXPECT_EQ(Predicate{}.text(), "");
}

TEST(Predicate, ComposesWithTheEmptyOne) {
  auto a = Predicate::parse("a");
  EXPECT_EQ(Predicate{} && a, a);
  EXPECT_EQ(a && Predicate{}, a);
  EXPECT_TRUE((a || Predicate{}).empty());
  EXPECT_THROW(!Predicate{}, PredicateError);
}

TEST(Predicate, ComposesWithoutSuperfluousParentheses) {
  auto a = Predicate::parse("a");
  auto b = Predicate::parse("b == 1");
  EXPECT_EQ((a && b && a).text(), "a && b == 1 && a");
  EXPECT_EQ(((a || b) && !b).text(), "(a || b == 1) && !(b == 1)");
  EXPECT_EQ((!(a && b)).text(), "!(a && b == 1)");
}

TEST(Predicate, IsOrderedByItsText) {
  std::set<Predicate> all{Predicate::parse("b"), Predicate::parse("a"), Predicate::parse(" a "),
                          Predicate{}};
  EXPECT_EQ(all.size(), 3u);
  EXPECT_TRUE(all.begin()->empty());
}

TEST(Predicate, DoesNotGrowBeyondWhatCanTravel) {
  auto x = Predicate::parse("a == 1");
  EXPECT_THAT(
    [&] {
      for (int i = 0; i < 30; ++i)
        x = x && x;
    },
    Throws<PredicateError>());
  EXPECT_EQ(Predicate::parse(x.text()), x);
  auto y = Predicate::parse("a == 1");
  EXPECT_THAT(
    [&] {
      for (int i = 0; i < 200; ++i)
        y = !(y && Predicate::parse("b"));
    },
    Throws<PredicateError>());
  EXPECT_EQ(Predicate::parse(y.text()), y);
}

TEST(Predicate, ComparesNumbersByValue) {
  Thing x;
  x.whole = -1;
  x.large = std::numeric_limits<std::uint64_t>::max();
  x.narrow = 0.5f;
  EXPECT_TRUE(is_true("whole == -1.0", x));
  EXPECT_TRUE(is_true("large > whole", x));
  EXPECT_TRUE(is_true("large == 18446744073709551615", x));
  EXPECT_FALSE(is_true("large == 18446744073709551616", x));
  EXPECT_TRUE(is_true("narrow == 0.5 && narrow < large", x));
}

TEST(Predicate, IsTwoValuedWhereAFieldIsAbsent) {
  EXPECT_FALSE(is_true("maybe == 0"));
  EXPECT_FALSE(is_true("maybe < 0 || maybe >= 0"));
  EXPECT_TRUE(is_true("maybe != 0"));
  EXPECT_TRUE(is_true("!(maybe == 0)"));
  EXPECT_FALSE(is_true("maybe == pose.heading"));
  EXPECT_TRUE(is_true("maybe != pose.heading"));
  EXPECT_FALSE(is_true("distance(pose.position, [0, 0, 0]) < 1"));
  EXPECT_TRUE(is_true("distance(pose.position, [0, 0, 0]) != 1"));
}

TEST(Predicate, AsksForPresence) {
  Thing x;
  EXPECT_FALSE(is_true("has(maybe)", x));
  EXPECT_FALSE(is_true("has(pose)", x));
  EXPECT_FALSE(is_true("has(pose.position.x)", x));
  EXPECT_TRUE(is_true("has(place)", x));
  x.maybe = 0;
  x.pose = Pose{};
  EXPECT_TRUE(is_true("has(maybe) && has(pose) && has(pose.position.x)", x));
}

TEST(Predicate, MeasuresDistances) {
  Thing x;
  x.place = {1, 2, 2};
  x.spot = {3, 4};
  EXPECT_TRUE(is_true("distance(place, [0, 0, 0]) == 3", x));
  EXPECT_TRUE(is_true("distance([0, 0], spot) == 5", x));
  EXPECT_TRUE(is_true("distance(place, place) == 0", x));
  x.pose = Pose{{1, 2, 0}, 0};
  EXPECT_TRUE(is_true("distance(place, pose.position) <= 2", x));
  x.place.x = std::numeric_limits<double>::infinity();
  x.place.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_true("distance(place, [0, 0, 0]) > 0", x));
}

TEST(Predicate, ComparesEnumeratorsByName) {
  Thing x;
  x.side = Side::right;
  EXPECT_TRUE(is_true("side == \"right\"", x));
  EXPECT_TRUE(is_true("side != \"left\"", x));
  x.side = static_cast<Side>(200);
  EXPECT_TRUE(is_true("side == \"200\"", x));
}

TEST(Predicate, IsFalseOfATypeThatLacksTheFields) {
  EXPECT_FALSE(Predicate::parse("nothing != 1").matches(Value::of(Thing{})));
  EXPECT_FALSE(Predicate::parse("!(nothing == 1)").matches(Value::of(Thing{})));
  EXPECT_FALSE(Predicate::parse("name != 1").matches(Value::of(Thing{})));
}

TEST(Predicate, SaysWhatItCannotBeAskedOf) {
  EXPECT_EQ(type_complaint("place.w == 1"), "Point has no field w; it has x, y, z");
  EXPECT_THAT(type_complaint("nothing == 1"),
              HasSubstr("Thing has no field nothing; it has name, "));
  EXPECT_THAT(type_complaint("number.x == 1"),
              HasSubstr("number of Thing has no fields of its own"));
  EXPECT_EQ(type_complaint("name == 1"),
            "name of Thing is a text and cannot be compared with a literal, a number");
  EXPECT_EQ(type_complaint("number == \"x\""),
            "number of Thing is a number and cannot be compared with \"x\", a text");
  EXPECT_THAT(type_complaint("flag > number"),
              HasSubstr("is a truth value and cannot be compared with "
                        "number of Thing, a number"));
  EXPECT_THAT(type_complaint("name"),
              HasSubstr("is a text and cannot be compared with true or false"));
  EXPECT_THAT(type_complaint("place == 1"), HasSubstr("place of Thing is a record"));
  EXPECT_THAT(type_complaint("spot == 1"), HasSubstr("spot of Thing is a list"));
  EXPECT_EQ(type_complaint("side == \"rigth\""),
            "Side has no enumerator \"rigth\"; it has left, right, both");
  EXPECT_THAT(type_complaint("side < \"right\""), HasSubstr("an enumeration, which has no order"));
  EXPECT_THAT(type_complaint("distance(name, [1, 2]) < 1"), HasSubstr("name of Thing is no point"));
  EXPECT_THAT(type_complaint("distance(place, [1, 2]) < 1"),
              HasSubstr("between a point of 3 coordinates and one of 2"));
  EXPECT_THAT(type_complaint("distance(spot, [1, 2]) < name"), HasSubstr("cannot be compared"));
  EXPECT_THAT(type_complaint("has(nothing)"), HasSubstr("Thing has no field nothing"));
  EXPECT_THAT(type_complaint("flag || nothing"), HasSubstr("Thing has no field nothing"));
}

TEST(Predicate, RefusesToCompareWithNaN) {
  auto nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(predicate::condition(predicate::Path{"a"}, Comparison::less, FieldValue{nan}),
               PredicateError);
  EXPECT_THROW(predicate::distance(predicate::Path{"a"}, predicate::Point{nan, 1}), PredicateError);
}

} // namespace castor::test
