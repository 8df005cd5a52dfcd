#include "castor/wm/values/encoding.hpp"

#include "castor/tests/wm/values/allocation_watch.hpp"
#include "castor/tests/wm/values/one_kind_types.hpp"
#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace castor::test {

namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

struct Texts {
  std::vector<std::string> s;
};
CASTOR_REFLECT(Texts, s)

struct Triple {
  std::array<std::int16_t, 3> n{};
};
CASTOR_REFLECT(Triple, n)

struct Maybe {
  std::optional<std::uint16_t> n;
};
CASTOR_REFLECT(Maybe, n)

struct SideAndTrend {
  Side side = Side::left;
  Trend trend = Trend::flat;
};
CASTOR_REFLECT(SideAndTrend, side, trend)

struct Inside {
  std::uint8_t before = 1;
  Triple triple;
  std::uint8_t after = 2;
};
CASTOR_REFLECT(Inside, before, triple, after)

struct Flags {
  std::vector<bool> flags;
};
CASTOR_REFLECT(Flags, flags)

struct Nested {
  std::vector<std::vector<std::optional<std::string>>> rows;

  bool operator==(const Nested&) const = default;
};
CASTOR_REFLECT(Nested, rows)

/// Large in memory, one byte on the wire while it is absent.
struct Roomy {
  std::vector<std::optional<std::array<double, 64>>> rooms;
};
CASTOR_REFLECT(Roomy, rooms)

Bytes bytes_of(std::initializer_list<int> values) {
  Bytes result;
  for (auto x : values)
    result.push_back(static_cast<std::uint8_t>(x));
  return result;
}

template <class T>
void expect_refused(const Bytes& bytes, const std::string& why) {
  EXPECT_THAT([&] { decode<T>(bytes); }, ThrowsMessage<DecodeError>(HasSubstr(why)));
}

Rich rich() {
  Rich x;
  x.numbers = {true,
               -128,
               -32768,
               std::numeric_limits<std::int32_t>::min(),
               std::numeric_limits<std::int64_t>::min(),
               255,
               65535,
               std::numeric_limits<std::uint32_t>::max(),
               std::numeric_limits<std::uint64_t>::max(),
               std::numeric_limits<float>::max(),
               std::numeric_limits<double>::denorm_min()};
  x.text = std::string{"nul \0 inside, \xff no UTF-8", 23};
  x.bytes = {0, 1, 255};
  x.chars = {'a', '\0', '\xff'};
  x.side = Side::both;
  x.trend = Trend::falling;
  x.huge = Huge::all;
  x.maybe_number = -0.5;
  x.maybe_pose = Pose{{1, 2, 3}, 4};
  x.maybe_texts = std::vector<std::string>{};
  x.triple = {-1, 0, 1};
  x.pair = {"", "second"};
  x.sides = {std::nullopt, Side::right};
  x.flags = {true, false, true};
  x.small = {-1, 127};
  x.doubles = {std::numeric_limits<double>::infinity(), -0.0};
  x.table = {{}, {1}, {2, 3}};
  x.gaps = {std::nullopt, Point{1, 2, 3}};
  x.pixels = {{0.5f, 1.5f}};
  x.trends = {Trend::rising, Trend::falling};
  x.blobs = {{}, {1, 2}};
  x.nothings = {{}, {}, {}};
  x.box = signed_box();
  x.boxes.emplace_back().label = "one";
  x.boxes.emplace_back().colours = {"blue"};
  x.tree = {"root", {{"left", {}}, {"right", {{"leaf", {}}}}}};
  x.last = 0xdeadbeef;
  return x;
}

} // namespace

// The wire form is a promise to other processes, journals and recordings: byte for byte.

TEST(Encoding, PutsNumbersAsTheyAreLittleEndian) {
  Numbers x;
  x.truth = true;
  x.i8 = -2;
  x.i16 = 0x0102;
  x.i32 = -1;
  x.u64 = 0x0102030405060708;
  x.f32 = 1;
  x.f64 = -2;
  EXPECT_EQ(encode(x), bytes_of({1,                                        // truth
                                 0xfe,                                     // i8
                                 2,    1,                                  // i16
                                 0xff, 0xff, 0xff, 0xff,                   // i32
                                 0,    0,    0,    0,    0, 0, 0, 0,       // i64
                                 0,                                        // u8
                                 0,    0,                                  // u16
                                 0,    0,    0,    0,                      // u32
                                 8,    7,    6,    5,    4, 3, 2, 1,       // u64
                                 0,    0,    0x80, 0x3f,                   // f32
                                 0,    0,    0,    0,    0, 0, 0, 0xc0})); // f64
}

TEST(Encoding, PutsTheLengthBeforeText) {
  EXPECT_EQ(encode(Text{"ab"}), bytes_of({2, 0, 0, 0, 'a', 'b'}));
  EXPECT_EQ(encode(Text{""}), bytes_of({0, 0, 0, 0}));
}

TEST(Encoding, PutsBytesInOnePiece) {
  EXPECT_EQ(encode(Blob{{7, 8, 9}}), bytes_of({3, 0, 0, 0, 7, 8, 9}));
}

TEST(Encoding, PutsLengthAndCountBeforeAList) {
  EXPECT_EQ(encode(Integers{{1, 2}}), bytes_of({12, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0}));
  EXPECT_EQ(encode(Integers{}), bytes_of({4, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(encode(Texts{{"a", ""}}),
            bytes_of({13, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 'a', 0, 0, 0, 0}));
  EXPECT_EQ(encode(Flags{{true, false}}), bytes_of({6, 0, 0, 0, 2, 0, 0, 0, 1, 0}));
}

TEST(Encoding, PutsAnArrayWithoutALength) {
  EXPECT_EQ(encode(Triple{{1, -1, 2}}), bytes_of({1, 0, 0xff, 0xff, 2, 0}));
}

TEST(Encoding, PutsAByteBeforeAnOptional) {
  EXPECT_EQ(encode(Maybe{}), bytes_of({0}));
  EXPECT_EQ(encode(Maybe{3}), bytes_of({1, 3, 0}));
}

TEST(Encoding, PutsAnEnumerationInTheWidthOfItsUnderlyingType) {
  EXPECT_EQ(encode(SideAndTrend{Side::both, Trend::falling}), bytes_of({255, 0xfb, 0xff}));
}

TEST(Encoding, PutsTheLengthBeforeARecordInsideARecord) {
  EXPECT_EQ(encode(Inside{}), bytes_of({1, 6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2}));
}

TEST(Encoding, PutsNothingForAStructWithoutFields) {
  EXPECT_EQ(encode(Nothing{}), Bytes{});
  EXPECT_EQ(decode<Nothing>({}), Nothing{});
}

TEST(Encoding, PutsADerivedValueAsItsBaseAndMore) {
  auto derived = signed_box();
  auto whole = encode(derived);
  auto base = encode(static_cast<const Box&>(derived));
  ASSERT_LT(base.size(), whole.size());
  EXPECT_TRUE(std::equal(base.begin(), base.end(), whole.begin()));
}

TEST(Encoding, GivesBackWhatWasPutIn) {
  EXPECT_EQ(decode<Rich>(encode(rich())), rich());
  EXPECT_EQ(decode<Rich>(encode(Rich{})), Rich{});
}

TEST(Encoding, GivesBackNestedListsOfOptionals) {
  Nested x{{{}, {std::nullopt, "", "text"}, {std::nullopt}}};
  EXPECT_EQ(decode<Nested>(encode(x)), x);
}

TEST(Encoding, GivesBackABaseOfADerivedValue) {
  auto derived = signed_box();
  auto bytes = encode(derived);
  EXPECT_EQ(decode<SignedBox>(bytes), derived);
  EXPECT_EQ(decode<PaintedBox>(bytes), static_cast<const PaintedBox&>(derived));
  EXPECT_EQ(decode<Box>(bytes), static_cast<const Box&>(derived));
}

TEST(Encoding, KeepsEveryBitOfAFloat) {
  for (auto x : {std::numeric_limits<double>::quiet_NaN(), -0.0,
                 std::numeric_limits<double>::infinity(), std::numeric_limits<double>::min()}) {
    auto back = decode<Point>(encode(Point{x, -x, 0}));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back.x), std::bit_cast<std::uint64_t>(x));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back.y), std::bit_cast<std::uint64_t>(-x));
  }
}

TEST(Encoding, KeepsAnEnumeratorThatHasNoName) {
  EXPECT_EQ(decode<SideAndTrend>(bytes_of({99, 0, 0})).side, static_cast<Side>(99));
}

TEST(Encoding, OverwritesWhatADecodedObjectHeld) {
  auto x = rich();
  auto empty = encode(Rich{});
  Decoder in{empty};
  in.get_fields(x);
  EXPECT_EQ(x, Rich{});
  EXPECT_EQ(in.remaining(), 0u);
}

TEST(Decoding, RefusesEveryTruncation) {
  auto bytes = encode(rich());
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(decode<Rich>(std::span{bytes}.first(n)), DecodeError) << n << " bytes";
}

TEST(Decoding, SaysHowManyBytesAreMissing) {
  expect_refused<Text>(bytes_of({5, 0, 0, 0, 'a', 'b'}), "5 bytes expected, 2 left");
}

TEST(Decoding, RefusesALengthBeyondTheEnd) {
  expect_refused<Text>(bytes_of({0xff, 0xff, 0xff, 0xff}), "ends early");
  expect_refused<Blob>(bytes_of({0xff, 0xff, 0xff, 0xff, 1}), "ends early");
  expect_refused<Integers>(bytes_of({9, 0, 0, 0, 1, 0, 0, 0}), "ends early");
}

TEST(Decoding, RefusesAListThatClaimsMoreElementsThanItHasBytes) {
  expect_refused<Integers>(bytes_of({4, 0, 0, 0, 0xff, 0xff, 0xff, 0xff}), "more elements");
  expect_refused<Integers>(bytes_of({8, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0}), "ends early");
}

TEST(Decoding, RefusesAListWithMoreBytesThanElements) {
  expect_refused<Integers>(bytes_of({9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 7}), "1 bytes too many");
}

TEST(Decoding, RefusesARecordWithMoreBytesThanFields) {
  expect_refused<Inside>(bytes_of({1, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 2}), "1 bytes too many");
}

TEST(Decoding, RefusesDeepNesting) {
  Tree tree{"leaf", {}};
  for (int i = 0; i < 200; ++i) {
    Tree parent{"node", {}};
    parent.children.push_back(std::move(tree));
    tree = std::move(parent);
  }
  expect_refused<Tree>(encode(tree), "nested too deeply");
}

TEST(Decoding, TakesWhatSensibleTypesNest) {
  Tree tree{"leaf", {}};
  for (int i = 0; i < 49; ++i) {
    Tree parent{"node", {}};
    parent.children.push_back(std::move(tree));
    tree = std::move(parent);
  }
  EXPECT_EQ(decode<Tree>(encode(tree)), tree);
}

TEST(Decoding, AllocatesNoMoreThanTheBytesCanFill) {
  // A thousand elements are claimed that would take half a megabyte in memory, but only the first
  // is a value.
  Bytes bytes = encode(Roomy{{1000, std::nullopt}});
  std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{1});
  AllocationWatch watch;
  EXPECT_THROW(decode<Roomy>(bytes), DecodeError);
  EXPECT_LT(watch.total(), 20'000u);
}

TEST(Decoding, SkipLandsAfterEachField) {
  auto x = rich();
  auto bytes = encode(x);
  auto& type = *descriptor_of<Rich>();
  Decoder in{bytes};
  auto& fields = type.records.front().fields;
  std::size_t i = 0;
  for_each_field<Rich>(x, [&](std::string_view name, const auto& member) {
    Bytes alone;
    Encoder{alone}.put(member);
    auto before = in.remaining();
    ASSERT_EQ(fields.at(i).name, name);
    in.skip(type, fields.at(i++).type);
    EXPECT_EQ(before - in.remaining(), alone.size()) << name;
  });
  EXPECT_EQ(in.remaining(), 0u);
}

TEST(Decoding, SkipRefusesEveryTruncation) {
  auto bytes = encode(rich());
  auto& type = *descriptor_of<Rich>();
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    Decoder in{std::span{bytes}.first(n)};
    EXPECT_THROW(for (auto& field
                      : type.records.front().fields) in.skip(type, field.type),
                 DecodeError)
      << n << " bytes";
  }
}

TEST(Decoding, KnowsTheSizeOfWhatHasOne) {
  EXPECT_EQ(fixed_size(WireKind::boolean), 1u);
  EXPECT_EQ(fixed_size(WireKind::int16), 2u);
  EXPECT_EQ(fixed_size(WireKind::float32), 4u);
  EXPECT_EQ(fixed_size(WireKind::uint64), 8u);
  for (auto kind : {WireKind::string, WireKind::bytes, WireKind::list, WireKind::array,
                    WireKind::optional, WireKind::record, WireKind::enumeration})
    EXPECT_EQ(fixed_size(kind), std::nullopt);
}

} // namespace castor::test
