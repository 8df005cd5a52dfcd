#include "castor/wm/values/value.hpp"

#include "castor/wm/values/descriptor_encoding.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <functional>
#include <thread>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// What another build of the robot, or another release, calls by the names used here.
namespace elsewhere {

struct Point {
  double x = 0;
  double y = 0;
  /// A float here.
  std::int32_t z = 0;
};
CASTOR_REFLECT(Point, x, y, z)

struct Pose {
  Point position;
  double heading = 0;
};
CASTOR_REFLECT(Pose, position, heading)

/// Looks like test::Box, but for what lies inside its pose.
struct Box {
  std::string label;
  Pose pose;
};
CASTOR_REFLECT(Box, label, pose)

struct GiftBox : Box {
  bool ribbon = true;
};
CASTOR_REFLECT_DERIVED(GiftBox, Box, ribbon)

} // namespace elsewhere

struct Kit {
  std::vector<int> list;
  std::array<std::int16_t, 2> pair{};
  Side side = Side::left;
  Pose pose;
  Tree tree;
};
CASTOR_REFLECT(Kit, list, pair, side, pose, tree)

struct BigKit : Kit {
  bool big = true;
};
CASTOR_REFLECT_DERIVED(BigKit, Kit, big)

/// The value as another process gets it.
Value arrived(const Value& x) {
  return Value::from_bytes(decode_descriptor(encode_descriptor(x.type())), x.bytes());
}

} // namespace

TEST(Value, IsEmptyByDefault) {
  EXPECT_FALSE(Value{}.has_value());
  EXPECT_TRUE(Value::of(Nothing{}).has_value());
  EXPECT_EQ(Value{}, Value{});
  EXPECT_FALSE(Value{} == Value::of(Nothing{}));
  EXPECT_FALSE(Value::of(Nothing{}) == Value{});
}

TEST(Value, GivesTheObjectItWasMadeOf) {
  auto x = Value::of(signed_box());
  ASSERT_TRUE(x.as<SignedBox>());
  EXPECT_EQ(*x.as<SignedBox>(), signed_box());
  EXPECT_EQ(x.type_name(), "SignedBox");
  EXPECT_EQ(x.type_ptr(), descriptor_of<SignedBox>());
}

TEST(Value, SharesOneObjectAmongCopies) {
  auto x = Value::of(signed_box());
  auto y = x;
  EXPECT_EQ(x.as<SignedBox>(), y.as<SignedBox>());
  EXPECT_EQ(x.as<SignedBox>(), x.as<SignedBox>());
  EXPECT_EQ(&x.bytes(), &y.bytes());
}

TEST(Value, GivesABaseWithoutACopy) {
  auto x = Value::of(signed_box());
  EXPECT_EQ(x.as<Box>().get(), static_cast<const Box*>(x.as<SignedBox>().get()));
  EXPECT_EQ(x.as<PaintedBox>().get(), static_cast<const PaintedBox*>(x.as<SignedBox>().get()));
}

TEST(Value, GivesNothingAsAnUnrelatedOrDerivedType) {
  auto x = Value::of(PaintedBox{});
  EXPECT_FALSE(x.as<SignedBox>());
  EXPECT_FALSE(x.as<Crate>());
  EXPECT_FALSE(x.as<Point>());
  EXPECT_FALSE(arrived(x).as<SignedBox>());
  EXPECT_FALSE(arrived(x).as<Point>());
}

TEST(Value, KeepsTheObjectAliveBeyondItself) {
  std::shared_ptr<const Box> base;
  {
    auto x = Value::of(signed_box());
    base = x.as<Box>();
  }
  EXPECT_EQ(base->label, "tea");
}

TEST(Value, MakesItsBytesOnce) {
  auto x = Value::of(signed_box());
  EXPECT_EQ(x.bytes(), encode(signed_box()));
  EXPECT_EQ(&x.bytes(), &x.bytes());
}

TEST(Value, IsDecodedWhereItArrives) {
  auto x = arrived(Value::of(signed_box()));
  ASSERT_TRUE(x.as<SignedBox>());
  EXPECT_EQ(*x.as<SignedBox>(), signed_box());
  EXPECT_EQ(*x.as<PaintedBox>(), static_cast<const PaintedBox&>(signed_box()));
  EXPECT_EQ(*x.as<Box>(), static_cast<const Box&>(signed_box()));
}

TEST(Value, IsDecodedOnceForEachTypeAskedFor) {
  auto x = arrived(Value::of(signed_box()));
  auto base = x.as<Box>();
  auto derived = x.as<SignedBox>();
  EXPECT_EQ(x.as<Box>(), base);
  EXPECT_EQ(x.as<SignedBox>(), derived);
  auto copy = x;
  EXPECT_EQ(copy.as<SignedBox>(), derived);
}

TEST(Value, RefusesAnotherTypeOfItsName) {
  auto theirs = arrived(Value::of(elsewhere::Point{}));
  EXPECT_THAT(
    [&] { theirs.as<Point>(); },
    ThrowsMessage<DecodeError>(AllOf(HasSubstr(to_string(*descriptor_of<Point>())),
                                     HasSubstr(to_string(*descriptor_of<elsewhere::Point>())))));
}

TEST(Value, RefusesABaseThatDiffersDeepInside) {
  auto theirs = arrived(Value::of(elsewhere::GiftBox{}));
  EXPECT_TRUE(theirs.as<elsewhere::Box>());
  EXPECT_THAT([&] { theirs.as<Box>(); },
              ThrowsMessage<DecodeError>(
                AllOf(HasSubstr("GiftBox"), HasSubstr("Box"), HasSubstr("this process knows"))));
}

TEST(Value, RefusesABaseWithAnyDifference) {
  // What another build may have changed in the base of a type that only it has.
  using Change = std::function<void(TypeDescriptor&)>;
  auto fields = [](TypeDescriptor & x) -> auto& {
    return x.records.front().fields;
  };
  auto record = [](TypeDescriptor& x, std::string_view name) -> RecordDescriptor& {
    return *std::find_if(x.records.begin(), x.records.end(),
                         [&](auto& candidate) { return candidate.name == name; });
  };
  auto as_kit = [](const Change& change) {
    auto type = *descriptor_of<BigKit>();
    type.records.front().name = "HugeKit";
    change(type);
    auto there = Value::from_bytes(std::make_shared<const TypeDescriptor>(type), encode(BigKit{}));
    return there.as<Kit>();
  };
  EXPECT_TRUE(as_kit([](auto&) {}));
  EXPECT_TRUE(as_kit([&](auto& x) { fields(x)[5].name = "what only the derived type has"; }));
  for (auto& change : std::vector<Change>{
         [&](auto& x) { fields(x)[0].name = "renamed"; },
         [&](auto& x) { fields(x)[0].type.element[0].kind = WireKind::float32; },
         [&](auto& x) { fields(x)[1].type.extent = 3; }, [&](auto& x) { fields(x).resize(4); },
         [&](auto& x) { std::swap(fields(x)[3], fields(x)[4]); },
         [&](auto& x) { x.enums[0].enumerators[0].first = "renamed"; },
         [&](auto& x) { x.enums[0].enumerators[0].second = 5; },
         [&](auto& x) { x.enums[0].underlying = WireKind::int8; },
         [&](auto& x) { record(x, "Pose").name = "Renamed"; },
         [&](auto& x) {
           record(x, "Pose").fields.push_back({"more", fields(x)[0].type});
         },
         [&](auto& x) { record(x, "Point").fields[2].type.kind = WireKind::int32; },
         [&](auto& x) { record(x, "Tree").fields[0].name = "renamed"; }})
    EXPECT_THAT([&] { as_kit(change); },
                ThrowsMessage<DecodeError>(HasSubstr("this process knows Kit {")));
}

TEST(Value, RefusesAnotherTypeOfItsNameFromItsOwnProcessToo) {
  EXPECT_THROW(Value::of(elsewhere::Point{}).as<Point>(), DecodeError);
  EXPECT_THROW(Value::of(elsewhere::GiftBox{}).as<Box>(), DecodeError);
}

TEST(Value, RefusesBytesThatAreNoSuchValue) {
  auto good = Value::of(signed_box());
  for (std::size_t n = 0; n < good.bytes().size(); ++n) {
    auto bad = Value::from_bytes(good.type_ptr(),
                                 {good.bytes().begin(), good.bytes().begin() + std::ptrdiff_t(n)});
    EXPECT_THROW(bad.as<SignedBox>(), DecodeError);
    EXPECT_THROW(bad.as<SignedBox>(), DecodeError) << "at the second time of asking";
  }
  auto longer = good.bytes();
  longer.push_back(0);
  EXPECT_THROW(Value::from_bytes(good.type_ptr(), longer).as<SignedBox>(), DecodeError);
}

TEST(Value, EqualsAValueOfTheSameContent) {
  auto x = Value::of(signed_box());
  EXPECT_EQ(x, x);
  EXPECT_EQ(x, Value::of(signed_box()));
  EXPECT_EQ(x, arrived(x));
  EXPECT_EQ(arrived(x), x);
  auto different = signed_box();
  different.signature.reset();
  EXPECT_FALSE(x == Value::of(different));
}

TEST(Value, DiffersFromAnotherTypeOfTheSameBytes) {
  EXPECT_EQ(Value::of(Box{}).bytes(), Value::of(Crate{}).bytes());
  EXPECT_FALSE(Value::of(Box{}) == Value::of(Crate{}));
}

TEST(Value, IsReadFromSeveralThreads) {
  auto here = Value::of(signed_box());
  auto there = arrived(here);
  auto fresh = Value::of(signed_box());
  constexpr int count = 4;
  std::barrier start{count};
  std::vector<std::thread> threads;
  std::array<std::shared_ptr<const SignedBox>, count> objects;
  std::array<const Bytes*, count> bytes{};
  std::array<bool, count> equal{};
  for (std::size_t i = 0; i < count; ++i)
    threads.emplace_back([&, i] {
      start.arrive_and_wait();
      auto base = i % 2 == 0 ? there.as<Box>() : nullptr;
      objects[i] = there.as<SignedBox>();
      bytes[i] = &fresh.bytes();
      equal[i] = fresh == there && (!base || *base == signed_box());
    });
  for (auto& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(objects[i], objects[0]);
    EXPECT_EQ(bytes[i], bytes[0]);
    EXPECT_TRUE(equal[i]);
  }
}

TEST(SelfDescribed, GivesBackTheValueWithItsType) {
  auto x = Value::of(signed_box());
  auto y = decode_self_described(encode_self_described(x));
  EXPECT_EQ(x, y);
  EXPECT_EQ(y.type(), x.type());
  EXPECT_EQ(*y.as<SignedBox>(), signed_box());
}

TEST(SelfDescribed, TakesAStructWithoutFields) {
  auto y = decode_self_described(encode_self_described(Value::of(Nothing{})));
  EXPECT_EQ(y, Value::of(Nothing{}));
}

TEST(SelfDescribed, RefusesEveryTruncationAndEveryExtension) {
  auto bytes = encode_self_described(Value::of(signed_box()));
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(decode_self_described(std::span{bytes}.first(n)), DecodeError) << n << " bytes";
  bytes.push_back(0);
  EXPECT_THROW(decode_self_described(bytes), DecodeError);
}

TEST(SelfDescribed, RefusesContentThatTheDescriptorDoesNotExplain) {
  for (auto content : {Bytes{}, Bytes(19), Bytes(21)}) {
    Bytes bytes;
    Encoder out{bytes};
    out.put(encode_descriptor(*descriptor_of<Point>()));
    out.put(content);
    EXPECT_THROW(decode_self_described(bytes), DecodeError) << content.size() << " bytes";
  }
}

} // namespace castor::test
