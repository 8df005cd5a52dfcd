#include "castor/wm/filters/predicate_builder.hpp"

#include "castor/tests/wm/filters/random_predicates.hpp"
#include "castor/wm/values/value.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace castor::test {

namespace {

/// Not declared as a whole.
struct Partial {
  int known = 0;
  int unknown = 0;
};
CASTOR_REFLECT(Partial, known)

struct Flat {
  double x = 0;
  double y = 0;
  std::string z;
};
CASTOR_REFLECT(Flat, x, y, z)

struct Deep : Point {
  int depth = 0;
};
CASTOR_REFLECT_DERIVED(Deep, Point, depth)

template <class A, class B>
concept Equatable = requires(const A& a, const B& b) {
  a == b;
  a != b;
};

template <class A, class B>
concept Comparable = Equatable<A, B> && requires(const A& a, const B& b) {
  a < b;
  a <= b;
  a > b;
  a >= b;
};

template <class A, class B>
concept Combinable = requires(const A& a, const B& b) {
  a&& b;
  a || b;
};

template <class A, class B>
concept Measurable = requires(const A& a, const B& b) {
  distance(a, b);
};

template <class... Members>
concept Path = requires(Members... members) {
  field(members...);
};

using Number = Field<Thing, double>;
using Whole = Field<Thing, std::int32_t>;
using Name = Field<Thing, std::string>;
using Flag = Field<Thing, bool>;
using Sided = Field<Thing, Side>;
using Place = Field<Thing, Point>;

static_assert(Comparable<Number, double> && Comparable<Number, int> && Comparable<Number, float>);
static_assert(Comparable<Whole, unsigned long> && Comparable<Whole, Number>);
static_assert(!Equatable<Number, bool> && !Equatable<Number, const char*>);
static_assert(!Equatable<Number, char> && !Equatable<Number, Side> && !Equatable<Number, Name>);
static_assert(Comparable<Name, const char*> && Comparable<Name, std::string>);
static_assert(Comparable<Name, std::string_view> && Comparable<Name, Name>);
static_assert(!Equatable<Name, int> && !Equatable<Name, char> && !Equatable<Name, bool>);
static_assert(Equatable<Flag, bool> && !Equatable<Flag, int> && !Equatable<Flag, const char*>);
static_assert(Equatable<Sided, Side> && !Equatable<Sided, Trend> && !Equatable<Sided, int>);
static_assert(!Equatable<Sided, const char*> && !Equatable<Sided, Field<Thing, Trend>>);
static_assert(Equatable<Sided, Sided> && !Comparable<Sided, Side>);
static_assert(!Equatable<Place, Point> && !Equatable<Place, Place>);
static_assert(Comparable<Number, Field<SpecialThing, float>>);
static_assert(!Equatable<Number, Field<Box, double>>);
static_assert(Comparable<DistanceOf<Thing>, double> && Comparable<DistanceOf<Thing>, Number>);
static_assert(Comparable<DistanceOf<Thing>, DistanceOf<SpecialThing>>);
static_assert(!Equatable<DistanceOf<Thing>, const char*>);
static_assert(!Equatable<DistanceOf<Thing>, Field<Box, double>>);

static_assert(Combinable<PredicateOf<Thing>, PredicateOf<SpecialThing>>);
static_assert(Combinable<PredicateOf<Thing>, Flag> && Combinable<Flag, Flag>);
static_assert(Combinable<Predicate, Predicate>);
static_assert(!Combinable<PredicateOf<Thing>, PredicateOf<Box>>);
static_assert(!Combinable<Flag, PredicateOf<Box>> && !Combinable<Flag, Field<Numbers, bool>>);
static_assert(!Combinable<PredicateOf<Thing>, Number> && !Combinable<Flag, Name>);

static_assert(Measurable<Place, Point> && Measurable<Place, Deep> && Measurable<Place, Place>);
static_assert(Measurable<Place, std::array<double, 3>> &&
              Measurable<Place, Field<Deep, Deep>> == false);
static_assert(!Measurable<Place, Flat> && !Measurable<Place, std::array<double, 2>>);
static_assert(!Measurable<Place, Field<Box, Point>> && !Measurable<Name, Point>);
static_assert(Measurable<Field<Thing, Flat>, std::array<float, 2>>);
static_assert(!Measurable<Place, std::array<std::string, 3>> && !Measurable<Place, double>);

static_assert(Path<double Thing::*> && Path<Point Thing::*, double Point::*>);
static_assert(Path<std::optional<Pose> Thing::*, Point Pose::*, double Point::*>);
static_assert(!Path<Point Thing::*, double Pose::*> && !Path<double Thing::*, double Point::*>);
static_assert(Path<Deep Rich::*, double Point::*>);

template <class T, class P>
constexpr bool is_over = std::is_same_v<P, PredicateOf<T>>;

} // namespace

TEST(PredicateBuilder, WritesWhatTheTextSays) {
  auto built = field(&Thing::number) > 0.8 && field(&Thing::name) == "box";
  EXPECT_EQ(built, Predicate::parse("number > 0.8 && name == \"box\""));
  built = field(&Thing::number) <= 1 || field(&Thing::whole) != 2u;
  EXPECT_EQ(built.text(), "number <= 1 || whole != 2");
  built = !(field(&Thing::narrow) < 0.5f && field(&Thing::large) >= 3);
  EXPECT_EQ(built.text(), "!(narrow < 0.5 && large >= 3)");
  EXPECT_EQ((field(&Thing::name) == std::string{"a\"b"}).text(), R"(name == "a\"b")");
  EXPECT_EQ((field(&Thing::number) == field(&Thing::whole)).text(), "number == whole");
  EXPECT_EQ((field(&Thing::number) < std::numeric_limits<double>::infinity()).text(),
            "number < 1e999");
  EXPECT_EQ(built, Predicate::parse(built.text()));
}

TEST(PredicateBuilder, FollowsMembersOfMembers) {
  EXPECT_EQ((field(&Thing::place, &Point::x) > 1).text(), "place.x > 1");
  EXPECT_EQ((field(&Thing::pose, &Pose::position, &Point::x) > 1).text(), "pose.position.x > 1");
  EXPECT_EQ((field(&Thing::maybe) == 1).text(), "maybe == 1");
}

TEST(PredicateBuilder, FindsMembersOfBases) {
  static_assert(std::is_same_v<decltype(field(&SpecialThing::number)), Field<Thing, double>>);
  auto built = field(&SpecialThing::number) > 1 && field(&SpecialThing::speciality) == "x";
  static_assert(is_over<SpecialThing, decltype(built)>);
  EXPECT_EQ(built.text(), "number > 1 && speciality == \"x\"");
  static_assert(
    is_over<SpecialThing, decltype(field(&Thing::name) == field(&SpecialThing::speciality))>);
}

TEST(PredicateBuilder, TakesTruthValuesAsTheyAre) {
  EXPECT_EQ((field(&Thing::flag) && !field(&Thing::flag)).text(), "flag && !flag");
  EXPECT_EQ((field(&Thing::flag) == false).text(), "flag == false");
  PredicateOf<Thing> alone = field(&Thing::flag);
  EXPECT_EQ(alone.text(), "flag");
}

TEST(PredicateBuilder, NamesEnumerators) {
  EXPECT_EQ((field(&Thing::side) == Side::right).text(), "side == \"right\"");
  EXPECT_EQ((field(&Thing::side) != static_cast<Side>(200)).text(), "side != \"200\"");
}

TEST(PredicateBuilder, MeasuresDistances) {
  EXPECT_EQ((distance(field(&Thing::place), Point{1, 2, 0.5f}) < 0.5).text(),
            "distance(place, [1, 2, 0.5]) < 0.5");
  EXPECT_EQ((distance(field(&Thing::place), field(&Thing::pose, &Pose::position)) < 2).text(),
            "distance(place, pose.position) < 2");
  EXPECT_EQ((distance(field(&Thing::spot), std::array<double, 2>{1, 2}) > 3).text(),
            "distance(spot, [1, 2]) > 3");
}

TEST(PredicateBuilder, AsksForPresence) {
  EXPECT_EQ((has(field(&Thing::maybe)) && !has(field(&Thing::pose))).text(),
            "has(maybe) && !has(pose)");
}

TEST(PredicateBuilder, BuildsWhatTheTypeAllows) {
  auto built = field(&Thing::number) > 0.8 && field(&Thing::side) == Side::right &&
               distance(field(&Thing::place), field(&Thing::pose, &Pose::position)) < 1 &&
               field(&Thing::flag) && has(field(&Thing::maybe));
  EXPECT_NO_THROW(built.check(*descriptor_of<Thing>()));
  EXPECT_NO_THROW(built.check(*descriptor_of<SpecialThing>()));
  Thing x;
  x.number = 1;
  x.side = Side::right;
  x.pose = Pose{};
  x.flag = true;
  EXPECT_FALSE(built.matches(Value::of(x)));
  x.maybe = 0;
  EXPECT_TRUE(built.matches(Value::of(x)));
}

TEST(PredicateBuilder, ChecksTextsAgainstTheType) {
  EXPECT_EQ(PredicateOf<Thing>::parse("number>1").text(), "number > 1");
  EXPECT_THROW(PredicateOf<Thing>::parse("nothing > 1"), FieldError);
  EXPECT_THROW(PredicateOf<Thing>::parse("number >"), PredicateError);
}

TEST(PredicateBuilder, RefusesMembersThatAreNoFields) {
  EXPECT_NO_THROW(field(&Partial::known));
  EXPECT_THROW(field(&Partial::unknown), FieldError);
}

TEST(PredicateBuilder, RefusesNaN) {
  auto nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(field(&Thing::number) > nan, PredicateError);
  EXPECT_THROW(distance(field(&Thing::place), Point{nan, 0, 0}), PredicateError);
}

} // namespace castor::test
