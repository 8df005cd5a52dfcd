#include "castor/wm/values/type_descriptor.hpp"

#include "castor/wm/values/descriptor_encoding.hpp"
#include "castor/wm/values/descriptor_of.hpp"

#include "castor/tests/wm/values/test_types.hpp"
#include "castor/wm/values/encoding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace castor::test {

namespace {

namespace namesakes {

/// The name of another type, with other fields.
struct Point {
  float u = 0;
};
CASTOR_REFLECT(Point, u)

enum class Side { top, bottom };
CASTOR_REFLECT_ENUM(Side, top, bottom)

/// The name of a struct.
enum class Pose { standing, lying };
CASTOR_REFLECT_ENUM(Pose, standing, lying)

/// The name of its own base.
struct Box : test::Box {};
CASTOR_REFLECT_DERIVED(Box, test::Box)

} // namespace namesakes

struct TwoPoints {
  Point mine;
  namesakes::Point theirs;
};
CASTOR_REFLECT(TwoPoints, mine, theirs)

struct TwoSides {
  Side mine = Side::left;
  namesakes::Side theirs = namesakes::Side::top;
};
CASTOR_REFLECT(TwoSides, mine, theirs)

struct TwoPoses {
  Pose mine;
  namesakes::Pose theirs = namesakes::Pose::lying;
};
CASTOR_REFLECT(TwoPoses, mine, theirs)

/// Hides a field of its base.
struct RelabelledBox : Box {
  std::string label;
};
CASTOR_REFLECT_DERIVED(RelabelledBox, Box, label)

struct SamePointTwice {
  Point a;
  std::vector<Point> b;
  Side c = Side::left;
  std::optional<Side> d;
};
CASTOR_REFLECT(SamePointTwice, a, b, c, d)

struct Renamed {
  double x = 0;
  double y = 0;
  float z = 0;
};
CASTOR_REFLECT(Renamed, x, y, z)

/// Looks the same whatever it refers to.
template <class T>
struct Reference {
  std::string id;
};

template <class T>
constexpr auto castor_reflection(TypeTag<Reference<T>>) {
  return record_reflection<Reference<T>, void>(
    "Reference", reflected_field<Reference<T>>("id", &Reference<T>::id));
}

struct TwoReferences {
  Reference<int> a;
  std::vector<Reference<double>> b;
};
CASTOR_REFLECT(TwoReferences, a, b)

using testing::HasSubstr;
using testing::ThrowsMessage;

WireType scalar(WireKind kind) {
  return {kind, 0, 0, {}};
}

WireType holding(WireKind kind, WireType element, std::uint32_t extent = 0) {
  return {kind, 0, extent, {std::move(element)}};
}

/// A descriptor with one field of the given type.
TypeDescriptor one_field(WireType type) {
  TypeDescriptor result;
  result.records = {{"R", {{"f", std::move(type)}}}};
  return result;
}

TypeDescriptorPtr through_the_wire(const TypeDescriptor& x) {
  return decode_descriptor(encode_descriptor(x));
}

void expect_refused(const TypeDescriptor& x, const std::string& why) {
  EXPECT_THAT([&] { through_the_wire(x); }, ThrowsMessage<DecodeError>(HasSubstr(why)));
}

} // namespace

TEST(TypeDescriptor, NamesTheTypeAndItsFields) {
  auto& type = *descriptor_of<Point>();
  EXPECT_EQ(type.name(), "Point");
  ASSERT_EQ(type.records.size(), 1u);
  EXPECT_EQ(type.records[0], (RecordDescriptor{"Point",
                                               {{"x", scalar(WireKind::float64)},
                                                {"y", scalar(WireKind::float64)},
                                                {"z", scalar(WireKind::float32)}}}));
  EXPECT_TRUE(type.enums.empty());
  EXPECT_TRUE(type.super_types.empty());
}

TEST(TypeDescriptor, NamesEveryWidthOfNumber) {
  auto& fields = descriptor_of<Numbers>()->records.front().fields;
  std::vector<WireKind> kinds;
  for (auto& field : fields)
    kinds.push_back(field.type.kind);
  EXPECT_EQ(kinds,
            (std::vector{WireKind::boolean, WireKind::int8, WireKind::int16, WireKind::int32,
                         WireKind::int64, WireKind::uint8, WireKind::uint16, WireKind::uint32,
                         WireKind::uint64, WireKind::float32, WireKind::float64}));
}

TEST(TypeDescriptor, DescribesContainersWithWhatTheyHold) {
  auto& fields = descriptor_of<Rich>()->records.front().fields;
  auto type_of = [&](std::string_view name) -> const WireType& {
    return std::find_if(fields.begin(), fields.end(), [&](auto& x) { return x.name == name; })
      ->type;
  };
  EXPECT_EQ(type_of("bytes"), scalar(WireKind::bytes));
  EXPECT_EQ(type_of("chars"), scalar(WireKind::bytes));
  EXPECT_EQ(type_of("small"), holding(WireKind::list, scalar(WireKind::int8)));
  EXPECT_EQ(type_of("flags"), holding(WireKind::list, scalar(WireKind::boolean)));
  EXPECT_EQ(type_of("triple"), holding(WireKind::array, scalar(WireKind::int16), 3));
  EXPECT_EQ(type_of("table"),
            holding(WireKind::list, holding(WireKind::list, scalar(WireKind::uint32))));
  EXPECT_EQ(type_of("maybe_texts"),
            holding(WireKind::optional, holding(WireKind::list, scalar(WireKind::string))));
}

TEST(TypeDescriptor, DescribesAnEnumerationWithItsWidthAndNumbers) {
  auto& enums = descriptor_of<Rich>()->enums;
  ASSERT_EQ(enums.size(), 3u);
  EXPECT_EQ(enums[0],
            (EnumDescriptor{"Side", WireKind::uint8, {{"left", 0}, {"right", 7}, {"both", 255}}}));
  EXPECT_EQ(enums[1], (EnumDescriptor{
                        "Trend", WireKind::int16, {{"falling", -5}, {"flat", 0}, {"rising", 40}}}));
  EXPECT_EQ(enums[2], (EnumDescriptor{"Huge", WireKind::uint64, {{"one", 1}, {"all", -1}}}));
}

TEST(TypeDescriptor, DescribesATypeThatIsUsedTwiceOnce) {
  auto& type = *descriptor_of<SamePointTwice>();
  EXPECT_EQ(type.records.size(), 2u);
  EXPECT_EQ(type.enums.size(), 1u);
}

TEST(TypeDescriptor, ListsSuperTypesNearestFirst) {
  EXPECT_EQ(descriptor_of<SignedBox>()->super_types,
            (std::vector<std::string>{"PaintedBox", "Box"}));
}

TEST(TypeDescriptor, PutsTheFieldsOfTheBasesFirst) {
  auto& derived = descriptor_of<SignedBox>()->records.front().fields;
  auto& base = descriptor_of<Box>()->records.front().fields;
  ASSERT_EQ(derived.size(), 5u);
  for (std::size_t i = 0; i < base.size(); ++i)
    EXPECT_EQ(derived[i].name, base[i].name);
}

TEST(TypeDescriptor, IsAKnowsTheTypeItselfAndItsSuperTypesOnly) {
  auto& type = *descriptor_of<PaintedBox>();
  EXPECT_TRUE(type.is_a("PaintedBox"));
  EXPECT_TRUE(type.is_a("Box"));
  EXPECT_FALSE(type.is_a("SignedBox"));
  EXPECT_FALSE(type.is_a("Pose"));
  EXPECT_FALSE(type.is_a(""));
}

TEST(TypeDescriptor, EndsAtARecursiveType) {
  auto& type = *descriptor_of<Tree>();
  ASSERT_EQ(type.records.size(), 1u);
  EXPECT_EQ(type.records[0].fields[1].type, holding(WireKind::list, {WireKind::record, 0, 0, {}}));
}

TEST(TypeDescriptor, DescribesAStructWithoutFields) {
  auto& type = *descriptor_of<Nothing>();
  EXPECT_EQ(type.name(), "Nothing");
  EXPECT_TRUE(type.records.front().fields.empty());
  EXPECT_EQ(*through_the_wire(type), type);
}

TEST(TypeDescriptor, IsBuiltOncePerProcess) {
  EXPECT_EQ(&descriptor_of<Rich>(), &descriptor_of<Rich>());
  EXPECT_EQ(type_name<Rich>(), "Rich");
}

TEST(TypeDescriptor, RefusesTwoStructsOfOneName) {
  EXPECT_THAT([] { descriptor_of<TwoPoints>(); }, ThrowsMessage<std::logic_error>(testing::AllOf(
                                                    HasSubstr("Point"), HasSubstr("TwoPoints"))));
}

TEST(TypeDescriptor, TakesTwoStructsOfOneNameThatHaveTheSameFields) {
  auto& descriptor = descriptor_of<TwoReferences>();
  EXPECT_EQ(*through_the_wire(*descriptor), *descriptor);
}

TEST(TypeDescriptor, RefusesTwoEnumerationsOfOneName) {
  EXPECT_THAT([] { descriptor_of<TwoSides>(); }, ThrowsMessage<std::logic_error>(testing::AllOf(
                                                   HasSubstr("Side"), HasSubstr("TwoSides"))));
}

TEST(TypeDescriptor, RefusesAnEnumerationWithTheNameOfAStruct) {
  EXPECT_THAT([] { descriptor_of<TwoPoses>(); }, ThrowsMessage<std::logic_error>(testing::AllOf(
                                                   HasSubstr("Pose"), HasSubstr("TwoPoses"))));
}

TEST(TypeDescriptor, RefusesATypeWithTheNameOfItsBase) {
  EXPECT_THAT([] { descriptor_of<namesakes::Box>(); },
              ThrowsMessage<std::logic_error>(HasSubstr("Box")));
}

TEST(TypeDescriptor, RefusesAFieldThatHidesAFieldOfTheBase) {
  EXPECT_THAT([] { descriptor_of<RelabelledBox>(); },
              ThrowsMessage<std::logic_error>(
                testing::AllOf(HasSubstr("label"), HasSubstr("RelabelledBox"))));
}

TEST(TypeDescriptor, HashesDifferWithTheNameTheFieldsAndTheBases) {
  EXPECT_NE(descriptor_of<Point>()->hash, descriptor_of<Renamed>()->hash);
  EXPECT_NE(descriptor_of<Point>()->hash, descriptor_of<namesakes::Point>()->hash);
  EXPECT_NE(descriptor_of<Box>()->hash, descriptor_of<Crate>()->hash);
  auto with_base = one_field(scalar(WireKind::int8));
  auto without_base = with_base;
  with_base.super_types = {"B"};
  EXPECT_NE(through_the_wire(with_base)->hash, through_the_wire(without_base)->hash);
}

TEST(TypeDescriptor, HashDoesNotChangeBetweenProcessesAndReleases) {
  // FNV-1a of the wire form, computed apart from this code: journals written by one build are read
  // by the next.
  EXPECT_EQ(descriptor_of<Point>()->hash, 0x5bed4125e6ab57f0ull);
}

TEST(TypeDescriptor, SurvivesTheWire) {
  EXPECT_EQ(*through_the_wire(*descriptor_of<Rich>()), *descriptor_of<Rich>());
  EXPECT_EQ(*through_the_wire(*descriptor_of<SignedBox>()), *descriptor_of<SignedBox>());
  EXPECT_EQ(*through_the_wire(*descriptor_of<Tree>()), *descriptor_of<Tree>());
}

TEST(TypeDescriptor, PrintsNameFieldsAndHashOnOneLine) {
  auto text = to_string(*descriptor_of<SignedBox>());
  EXPECT_THAT(text, testing::StartsWith("SignedBox {label: string, pose: Pose, colours: list of "
                                        "string, side: Side, signature: optional string} #"));
  EXPECT_EQ(text.size() - text.find('#'), 17u);
  EXPECT_THAT(to_string(*descriptor_of<Nothing>()), testing::StartsWith("Nothing {} #"));
}

TEST(TypeDescriptor, PrintsNestedContainers) {
  auto text = to_string(*descriptor_of<Rich>());
  EXPECT_THAT(text, HasSubstr("table: list of list of uint32"));
  EXPECT_THAT(text, HasSubstr("sides: 2 of optional Side"));
  EXPECT_THAT(text, HasSubstr("triple: 3 of int16"));
}

TEST(TypeDescriptor, RefusesADescriptorWithoutARecord) {
  expect_refused({}, "without a record");
}

TEST(TypeDescriptor, RefusesAnUnknownWireKind) {
  expect_refused(one_field(scalar(static_cast<WireKind>(18))), "unknown wire kind");
  expect_refused(one_field(scalar(static_cast<WireKind>(255))), "unknown wire kind");
}

TEST(TypeDescriptor, RefusesARecordThatItLacks) {
  expect_refused(one_field({WireKind::record, 1, 0, {}}), "refers to a record");
  expect_refused(one_field({WireKind::record, 0xffffffff, 0, {}}), "refers to a record");
}

TEST(TypeDescriptor, RefusesAnEnumerationThatItLacks) {
  expect_refused(one_field({WireKind::enumeration, 0, 0, {}}), "refers to an enumeration");
}

TEST(TypeDescriptor, RefusesAnEnumerationThatIsNoInteger) {
  for (auto kind : {WireKind::boolean, WireKind::float64, WireKind::string, WireKind::enumeration,
                    static_cast<WireKind>(99)}) {
    auto type = one_field({WireKind::enumeration, 0, 0, {}});
    type.enums = {{"E", kind, {{"a", 0}}}};
    expect_refused(type, "no integer");
  }
}

TEST(TypeDescriptor, RefusesContainersWithoutExactlyOneElementType) {
  for (auto kind : {WireKind::list, WireKind::array, WireKind::optional}) {
    expect_refused(one_field({kind, 0, 1, {}}), "exactly one element type");
    expect_refused(one_field({kind, 0, 1, {scalar(WireKind::int8), scalar(WireKind::int8)}}),
                   "exactly one element type");
  }
  expect_refused(one_field({WireKind::int8, 0, 0, {scalar(WireKind::int8)}}),
                 "exactly one element type");
}

TEST(TypeDescriptor, RefusesAnArrayWithoutElements) {
  expect_refused(one_field(holding(WireKind::array, scalar(WireKind::int8), 0)),
                 "array without elements");
}

TEST(TypeDescriptor, ChecksWhatContainersHoldToo) {
  expect_refused(
    one_field(holding(WireKind::list, holding(WireKind::optional, {WireKind::record, 7, 0, {}}))),
    "refers to a record");
}

TEST(TypeDescriptor, RefusesDeepNesting) {
  auto type = scalar(WireKind::int8);
  for (int i = 0; i < 16; ++i)
    type = holding(WireKind::list, type);
  EXPECT_NO_THROW(through_the_wire(one_field(type)));
  expect_refused(one_field(holding(WireKind::list, type)), "nested too deeply");
}

TEST(TypeDescriptor, RefusesNamesThatOccurTwice) {
  auto two_fields = one_field(scalar(WireKind::int8));
  two_fields.records[0].fields.push_back({"f", scalar(WireKind::string)});
  expect_refused(two_fields, "f");
  auto two_records = one_field({WireKind::record, 1, 0, {}});
  two_records.records.push_back({"R", {}});
  expect_refused(two_records, "R");
  auto two_enums = one_field({WireKind::enumeration, 1, 0, {}});
  two_enums.enums = {{"E", WireKind::int8, {}}, {"E", WireKind::int8, {}}};
  expect_refused(two_enums, "E");
  auto own_base = one_field(scalar(WireKind::int8));
  own_base.super_types = {"R"};
  expect_refused(own_base, "R");
  auto same_base_twice = one_field(scalar(WireKind::int8));
  same_base_twice.super_types = {"B", "B"};
  expect_refused(same_base_twice, "B");
}

TEST(TypeDescriptor, MayContainItsOwnBaseAsAField) {
  auto type = one_field({WireKind::record, 1, 0, {}});
  type.records.push_back({"B", {}});
  type.super_types = {"B"};
  EXPECT_NO_THROW(through_the_wire(type));
}

TEST(TypeDescriptor, RefusesTrailingAndMissingBytes) {
  auto bytes = encode_descriptor(*descriptor_of<Rich>());
  bytes.push_back(0);
  EXPECT_THROW(decode_descriptor(bytes), DecodeError);
  bytes.pop_back();
  bytes.pop_back();
  EXPECT_THROW(decode_descriptor(bytes), DecodeError);
  EXPECT_THROW(decode_descriptor({}), DecodeError);
}

} // namespace castor::test
