#include "castor/wm/values/reflect.hpp"

#include "castor/tests/wm/values/test_types.hpp"
#include "castor/wm/values/encoding.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

namespace {

/// As many fields as the macro promises to take.
struct SixtyFour {
  int f0 = 0, f1 = 1, f2 = 2, f3 = 3, f4 = 4, f5 = 5, f6 = 6, f7 = 7, f8 = 8, f9 = 9;
  int f10 = 10, f11 = 11, f12 = 12, f13 = 13, f14 = 14, f15 = 15, f16 = 16, f17 = 17, f18 = 18;
  int f19 = 19, f20 = 20, f21 = 21, f22 = 22, f23 = 23, f24 = 24, f25 = 25, f26 = 26, f27 = 27;
  int f28 = 28, f29 = 29, f30 = 30, f31 = 31, f32 = 32, f33 = 33, f34 = 34, f35 = 35, f36 = 36;
  int f37 = 37, f38 = 38, f39 = 39, f40 = 40, f41 = 41, f42 = 42, f43 = 43, f44 = 44, f45 = 45;
  int f46 = 46, f47 = 47, f48 = 48, f49 = 49, f50 = 50, f51 = 51, f52 = 52, f53 = 53, f54 = 54;
  int f55 = 55, f56 = 56, f57 = 57, f58 = 58, f59 = 59, f60 = 60, f61 = 61, f62 = 62, f63 = 63;
};
CASTOR_REFLECT(SixtyFour, f0, f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16,
               f17, f18, f19, f20, f21, f22, f23, f24, f25, f26, f27, f28, f29, f30, f31, f32, f33,
               f34, f35, f36, f37, f38, f39, f40, f41, f42, f43, f44, f45, f46, f47, f48, f49, f50,
               f51, f52, f53, f54, f55, f56, f57, f58, f59, f60, f61, f62, f63)

enum class Letter { a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z };
CASTOR_REFLECT_ENUM(Letter, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x,
                    y, z)

struct NotDeclared {
  int x = 0;
};

enum class NotDeclaredEither { one };

template <class T>
std::vector<std::string> field_names(T object = {}) {
  std::vector<std::string> result;
  for_each_field<T>(object, [&](std::string_view name, auto&) { result.emplace_back(name); });
  return result;
}

using Names = std::vector<std::string>;

} // namespace

TEST(Reflect, NamesTheFieldsInTheOrderOfTheDeclaration) {
  EXPECT_EQ(field_names<Point>(), (Names{"x", "y", "z"}));
}

TEST(Reflect, VisitsTheFieldsOfAllBasesFirst) {
  EXPECT_EQ(field_names<SignedBox>(), (Names{"label", "pose", "colours", "side", "signature"}));
}

TEST(Reflect, TakesAStructWithoutFields) {
  EXPECT_EQ(field_names<Nothing>(), Names{});
  EXPECT_EQ(reflection_of<Nothing>().name, "Nothing");
}

TEST(Reflect, TakesADerivedStructThatAddsNoFields) {
  EXPECT_EQ(field_names<Crate>(), (Names{"label", "pose"}));
}

TEST(Reflect, TakesSixtyFourFields) {
  SixtyFour object;
  std::vector<std::pair<std::string, int>> seen;
  for_each_field<SixtyFour>(
    object, [&](std::string_view name, const int& value) { seen.emplace_back(name, value); });
  ASSERT_EQ(seen.size(), 64u);
  for (int i = 0; i < 64; ++i)
    EXPECT_EQ(seen[static_cast<std::size_t>(i)], std::pair("f" + std::to_string(i), i));
}

TEST(Reflect, SixtyFourFieldsSurviveTheWire) {
  SixtyFour object;
  object.f0 = -1;
  object.f63 = -64;
  auto bytes = encode(object);
  EXPECT_EQ(bytes.size(), 64 * sizeof(int));
  auto back = decode<SixtyFour>(bytes);
  EXPECT_EQ(back.f0, -1);
  EXPECT_EQ(back.f31, 31);
  EXPECT_EQ(back.f63, -64);
}

TEST(Reflect, GivesWriteAccessToAMutableObject) {
  Point point{1, 2, 3};
  for_each_field<Point>(point, [](std::string_view, auto& member) { member = 9; });
  EXPECT_EQ(point, (Point{9, 9, 9}));
}

TEST(Reflect, GivesOnlyReadAccessToAConstObject) {
  const Point point{1, 2, 3};
  double sum = 0;
  for_each_field<Point>(point, [&](std::string_view, auto& member) {
    static_assert(std::is_const_v<std::remove_reference_t<decltype(member)>>);
    sum += member;
  });
  EXPECT_EQ(sum, 6);
}

TEST(Reflect, NamesEnumeratorsWithTheirNumbers) {
  constexpr auto reflection = reflection_of<Trend>();
  EXPECT_EQ(reflection.name, "Trend");
  ASSERT_EQ(std::size(reflection.enumerators), 3u);
  EXPECT_EQ(reflection.enumerators[0], (std::pair<std::string_view, Trend>("falling", Trend{-5})));
  EXPECT_EQ(reflection.enumerators[1], (std::pair<std::string_view, Trend>("flat", Trend{0})));
  EXPECT_EQ(reflection.enumerators[2], (std::pair<std::string_view, Trend>("rising", Trend{40})));
}

TEST(Reflect, TakesManyEnumerators) {
  constexpr auto reflection = reflection_of<Letter>();
  ASSERT_EQ(std::size(reflection.enumerators), 26u);
  EXPECT_EQ(reflection.enumerators[25], (std::pair<std::string_view, Letter>("z", Letter::z)));
}

TEST(Reflect, TellsDeclaredTypesFromOthers) {
  static_assert(ReflectedRecord<Point> && ReflectedRecord<SignedBox> && ReflectedRecord<Nothing>);
  static_assert(ReflectedEnum<Side>);
  static_assert(!ReflectedRecord<NotDeclared> && !ReflectedEnum<NotDeclaredEither>);
  static_assert(!ReflectedRecord<Side> && !ReflectedEnum<Point>);
  static_assert(!ReflectedRecord<int> && !ReflectedRecord<std::string>);
  EXPECT_EQ(NotDeclared{}.x, static_cast<int>(NotDeclaredEither::one));
}

} // namespace castor::test
