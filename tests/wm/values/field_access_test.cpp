#include "castor/wm/values/field_access.hpp"

#include "castor/tests/wm/values/one_kind_types.hpp"
#include "castor/tests/wm/values/test_types.hpp"
#include "castor/wm/values/encoding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Optionals {
  std::optional<Pose> pose;
  std::optional<std::string> text;
  std::optional<std::optional<int>> twice;
  std::optional<std::vector<int>> list;
  int last = 0;
};
CASTOR_REFLECT(Optionals, pose, text, twice, list, last)

template <class T>
FieldValue field_of(const T& x, std::string_view path) {
  return read_field(*descriptor_of<T>(), encode(x), path);
}

/// The six comparisons, in the order of their declaration, as six digits.
std::string all(const FieldValue& a, const FieldValue& b) {
  std::string result;
  for (auto op : {Comparison::equal, Comparison::not_equal, Comparison::less,
                  Comparison::less_equal, Comparison::greater, Comparison::greater_equal})
    result += compare(a, op, b) ? '1' : '0';
  return result;
}

constexpr auto equal = "100101";
constexpr auto less = "011100";
constexpr auto greater = "010011";
constexpr auto unordered = "010000";

FieldValue i(std::int64_t x) {
  return x;
}

FieldValue u(std::uint64_t x) {
  return x;
}

} // namespace

TEST(ReadField, GivesEveryKindOfNumber) {
  Numbers x{true, -1, -2, -3, -4, 5, 6, 7, 8, 0.5f, 0.25};
  EXPECT_EQ(field_of(x, "truth"), FieldValue{true});
  EXPECT_EQ(field_of(x, "i8"), i(-1));
  EXPECT_EQ(field_of(x, "i16"), i(-2));
  EXPECT_EQ(field_of(x, "i32"), i(-3));
  EXPECT_EQ(field_of(x, "i64"), i(-4));
  EXPECT_EQ(field_of(x, "u8"), u(5));
  EXPECT_EQ(field_of(x, "u16"), u(6));
  EXPECT_EQ(field_of(x, "u32"), u(7));
  EXPECT_EQ(field_of(x, "u64"), u(8));
  EXPECT_EQ(field_of(x, "f32"), FieldValue{0.5});
  EXPECT_EQ(field_of(x, "f64"), FieldValue{0.25});
}

TEST(ReadField, FollowsAPathIntoRecords) {
  EXPECT_EQ(field_of(signed_box(), "pose.position.y"), FieldValue{-2.25});
  EXPECT_EQ(field_of(signed_box(), "pose.heading"), FieldValue{3.0});
}

TEST(ReadField, FindsFieldsBehindAndInsideTheBases) {
  EXPECT_EQ(field_of(signed_box(), "label"), FieldValue{"tea"});
  EXPECT_EQ(field_of(signed_box(), "side"), FieldValue{"right"});
  EXPECT_EQ(field_of(signed_box(), "signature"), FieldValue{"Nick"});
}

TEST(ReadField, StepsOverEverythingElse) {
  Rich x;
  x.text = "abc";
  x.table = {{1, 2}, {}};
  x.boxes.resize(3);
  x.last = 42;
  EXPECT_EQ(field_of(x, "last"), u(42));
  EXPECT_EQ(field_of(x, "box.signature"), FieldValue{});
  EXPECT_EQ(field_of(x, "numbers.u8"), u(0));
}

TEST(ReadField, NamesEnumerators) {
  Chosen x{Side::both, Trend::falling, Huge::all};
  EXPECT_EQ(field_of(x, "side"), FieldValue{"both"});
  EXPECT_EQ(field_of(x, "trend"), FieldValue{"falling"});
  EXPECT_EQ(field_of(x, "huge"), FieldValue{"all"});
}

TEST(ReadField, GivesTheNumberOfAnEnumeratorWithoutAName) {
  Chosen x{static_cast<Side>(200), static_cast<Trend>(-1), static_cast<Huge>(0xfffffffffffffffe)};
  EXPECT_EQ(field_of(x, "side"), FieldValue{"200"});
  EXPECT_EQ(field_of(x, "trend"), FieldValue{"-1"});
  EXPECT_EQ(field_of(x, "huge"), FieldValue{"18446744073709551614"});
}

TEST(ReadField, GivesNothingForAnAbsentOptional) {
  Optionals x;
  EXPECT_EQ(field_of(x, "text"), FieldValue{});
  EXPECT_EQ(field_of(x, "pose.heading"), FieldValue{});
  EXPECT_EQ(field_of(x, "twice"), FieldValue{});
  x.twice.emplace();
  EXPECT_EQ(field_of(x, "twice"), FieldValue{});
}

TEST(ReadField, LooksIntoAnOptionalThatIsThere) {
  Optionals x;
  x.pose = Pose{{}, 2};
  x.text = "";
  x.twice = 7;
  x.list = std::vector{1, 2, 3};
  x.last = 9;
  EXPECT_EQ(field_of(x, "pose.heading"), FieldValue{2.0});
  EXPECT_EQ(field_of(x, "text"), FieldValue{""});
  EXPECT_EQ(field_of(x, "twice"), i(7));
  EXPECT_EQ(field_of(x, "last"), i(9));
}

TEST(ReadField, KeepsTextAsItIs) {
  Box x;
  x.label = std::string{"\0\xff", 2};
  EXPECT_EQ(field_of(x, "label"), FieldValue{x.label});
}

TEST(ReadField, NamesTheFieldsThatThereAre) {
  EXPECT_THAT([] { field_of(signed_box(), "pose.position.w"); },
              ThrowsMessage<FieldError>(
                AllOf(HasSubstr("Point has no field w"), HasSubstr("it has x, y, z"))));
  EXPECT_THAT([] { field_of(signed_box(), "lable"); },
              ThrowsMessage<FieldError>(AllOf(HasSubstr("SignedBox has no field lable"),
                                              HasSubstr("label, pose, colours"))));
}

TEST(ReadField, RefusesAPathThroughAScalar) {
  EXPECT_THAT([] { field_of(signed_box(), "label.x"); },
              ThrowsMessage<FieldError>(HasSubstr("label of SignedBox has no fields")));
  EXPECT_THROW(field_of(signed_box(), "colours.x"), FieldError);
  EXPECT_THROW(field_of(signed_box(), "side.x"), FieldError);
}

TEST(ReadField, RefusesEmptyPartsOfAPath) {
  for (auto path : {"", ".", "pose.", ".pose", "pose..heading", "pose.heading."})
    EXPECT_THROW(field_of(signed_box(), path), FieldError) << path;
}

TEST(ReadField, RefusesListsAndWholeRecords) {
  for (auto path : {"pose", "pose.position", "colours"})
    EXPECT_THAT([&] { field_of(signed_box(), path); },
                ThrowsMessage<FieldError>(HasSubstr("name one of its fields")));
  EXPECT_THROW(field_of(Rich{}, "bytes"), FieldError);
  EXPECT_THROW(field_of(Rich{}, "triple"), FieldError);
}

TEST(ReadField, FindsAMistakeInThePathWhetherOrNotTheOptionalIsThere) {
  Optionals absent;
  Optionals present;
  present.pose.emplace();
  present.list.emplace();
  present.text.emplace();
  for (auto path : {"pose.nonsense", "pose.position", "pose", "list", "list.x", "text.x"}) {
    EXPECT_THROW(field_of(present, path), FieldError) << path;
    EXPECT_THROW(field_of(absent, path), FieldError) << path;
  }
}

TEST(ReadField, RefusesTruncatedBytes) {
  auto bytes = encode(signed_box());
  for (std::size_t n = 0; n + 5 < bytes.size(); ++n)
    EXPECT_THROW(read_field(*descriptor_of<SignedBox>(), std::span{bytes}.first(n), "signature"),
                 DecodeError);
}

TEST(Compare, OrdersNumbersOfOneType) {
  EXPECT_EQ(all(i(-1), i(-1)), equal);
  EXPECT_EQ(all(i(-1), i(1)), less);
  EXPECT_EQ(all(u(2), u(1)), greater);
  EXPECT_EQ(all(0.5, 0.5), equal);
  EXPECT_EQ(all(0.5, 0.25), greater);
  EXPECT_EQ(all(0.0, -0.0), equal);
}

TEST(Compare, OrdersSignedAndUnsignedByValue) {
  EXPECT_EQ(all(i(-1), u(0xffffffffffffffff)), less);
  EXPECT_EQ(all(u(0xffffffffffffffff), i(-1)), greater);
  EXPECT_EQ(all(i(5), u(5)), equal);
  EXPECT_EQ(all(u(5), i(5)), equal);
  EXPECT_EQ(all(u(4), i(5)), less);
  EXPECT_EQ(all(i(std::numeric_limits<std::int64_t>::max()), u(1ull << 63)), less);
}

TEST(Compare, OrdersIntegersAndFloatsExactly) {
  // 2^53 + 1 and 2^64 - 1 are no doubles: converting the integer would round it.
  EXPECT_EQ(all(i((1ll << 53) + 1), 9007199254740992.0), greater);
  EXPECT_EQ(all(9007199254740992.0, i((1ll << 53) + 1)), less);
  EXPECT_EQ(all(i(1ll << 53), 9007199254740992.0), equal);
  EXPECT_EQ(all(u(0xffffffffffffffff), 18446744073709551616.0), less);
  EXPECT_EQ(all(18446744073709551616.0, u(0xffffffffffffffff)), greater);
  EXPECT_EQ(all(i(std::numeric_limits<std::int64_t>::min()), -9223372036854775808.0), equal);
  EXPECT_EQ(all(u(1), 1.5), less);
  EXPECT_EQ(all(-0.5, i(0)), less);
  EXPECT_EQ(all(u(1), std::numeric_limits<double>::infinity()), less);
}

TEST(Compare, FindsNaNUnequalToEverything) {
  auto nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(all(nan, nan), unordered);
  EXPECT_EQ(all(nan, 1.0), unordered);
  EXPECT_EQ(all(i(1), nan), unordered);
  EXPECT_EQ(all(nan, u(1)), unordered);
}

TEST(Compare, FindsAnAbsentOptionalUnequalToEverything) {
  EXPECT_EQ(all({}, {}), unordered);
  EXPECT_EQ(all({}, i(1)), unordered);
  EXPECT_EQ(all(u(1), {}), unordered);
  EXPECT_EQ(all(1.0, {}), unordered);
  EXPECT_EQ(all({}, "text"), unordered);
  EXPECT_EQ(all(true, {}), unordered);
}

TEST(Compare, OrdersTextByCodeUnits) {
  EXPECT_EQ(all("a", "a"), equal);
  EXPECT_EQ(all("", "a"), less);
  EXPECT_EQ(all("b", "aa"), greater);
  EXPECT_EQ(all("Z", "a"), less);
  EXPECT_EQ(all("\xff", "a"), greater);
  EXPECT_EQ(all(std::string{"a\0b", 3}, std::string{"a\0c", 3}), less);
}

TEST(Compare, OrdersFalseBeforeTrue) {
  EXPECT_EQ(all(false, true), less);
  EXPECT_EQ(all(true, true), equal);
  EXPECT_EQ(all(true, false), greater);
}

TEST(Compare, RefusesToMixNumbersTruthValuesAndTexts) {
  std::vector<std::vector<FieldValue>> groups{{true}, {i(1), u(1), 1.0}, {"1"}};
  for (auto& a : groups) {
    for (auto& b : groups) {
      if (&a == &b)
        continue;
      for (auto& x : a)
        for (auto& y : b)
          EXPECT_THAT([&] { compare(x, Comparison::equal, y); },
                      ThrowsMessage<FieldError>(HasSubstr("cannot be compared")));
    }
  }
}

} // namespace castor::test
