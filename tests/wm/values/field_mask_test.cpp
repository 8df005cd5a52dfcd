#include "castor/wm/values/field_mask.hpp"

#include "castor/wm/values/descriptor_encoding.hpp"
#include "castor/wm/values/value.hpp"

#include "castor/tests/wm/values/any_object.hpp"
#include "castor/tests/wm/values/opaque_value.hpp"
#include "castor/tests/wm/values/random_values.hpp"
#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

template <class T>
std::vector<std::string> changed(const T& before, const T& after) {
  return field_names(*descriptor_of<T>(), changed_fields(Value::of(before), Value::of(after)));
}

/// A type with so many fields, each an `int8`.
TypeDescriptorPtr wide(std::size_t fields) {
  TypeDescriptor result;
  result.records.push_back({"Wide", {}});
  for (std::size_t i = 0; i < fields; ++i)
    result.records[0].fields.push_back({"f" + std::to_string(i), {WireKind::int8, 0, 0, {}}});
  return decode_descriptor(encode_descriptor(result));
}

} // namespace

TEST(FieldMask, CountsFieldsInWireOrder) {
  auto& type = *descriptor_of<SignedBox>();
  EXPECT_EQ(field_bit(type, "label"), 1u);
  EXPECT_EQ(field_bit(type, "signature"), 16u);
  EXPECT_EQ(field_bit(type, "nothing"), 0u);
  EXPECT_EQ(all_fields(type), 31u);
  EXPECT_THAT(field_names(type, 18), ElementsAre("pose", "signature"));
}

TEST(FieldMask, LetsTheLastFieldsShareABit) {
  EXPECT_EQ(all_fields(*wide(63)), ~FieldMask{0} >> 1);
  EXPECT_EQ(all_fields(*wide(64)), ~FieldMask{0});
  auto type = wide(70);
  EXPECT_EQ(all_fields(*type), ~FieldMask{0});
  EXPECT_EQ(field_bit(*type, "f63"), field_bit(*type, "f69"));
  EXPECT_NE(field_bit(*type, "f62"), field_bit(*type, "f63"));
  Bytes before(70);
  auto after = before;
  after[66] = 1;
  auto mask = changed_fields(Value::from_bytes(type, before), Value::from_bytes(type, after));
  EXPECT_EQ(mask, field_bit(63));
  EXPECT_EQ(field_names(*type, mask).size(), 7u);
}

TEST(ChangedFields, NamesTopLevelFields) {
  auto box = signed_box();
  EXPECT_THAT(changed(signed_box(), box), IsEmpty());
  box.pose.position.z += 1;
  EXPECT_THAT(changed(signed_box(), box), ElementsAre("pose"));
  box.label = "coffee";
  box.colours.pop_back();
  box.side = Side::left;
  box.signature.reset();
  EXPECT_THAT(changed(signed_box(), box),
              ElementsAre("label", "pose", "colours", "side", "signature"));
}

TEST(ChangedFields, ComparesNumbersBitByBit) {
  Numbers a;
  Numbers b;
  b.f64 = -0.0;
  EXPECT_THAT(changed(a, b), ElementsAre("f64"));
  a.f64 = b.f64 = std::nan("");
  EXPECT_THAT(changed(a, b), IsEmpty());
  b.f32 = std::numeric_limits<float>::denorm_min();
  EXPECT_THAT(changed(a, b), ElementsAre("f32"));
}

TEST(ChangedFields, OfAValueAndItselfAreNone) {
  auto x = Value::of(signed_box());
  EXPECT_EQ(changed_fields(x, x), 0u);
}

TEST(ChangedFields, OfDifferentTypesAreAll) {
  EXPECT_EQ(changed_fields(Value::of(Box{}), Value::of(signed_box())), 31u);
}

TEST(ChangedFields, AreFoundBetweenAnObjectAndBytes) {
  auto box = signed_box();
  box.side = Side::left;
  auto before = Value::of(signed_box());
  auto after = Value::of(box);
  EXPECT_EQ(changed_fields(opaque(before), after), 8u);
  EXPECT_EQ(changed_fields(before, opaque(after)), 8u);
}

RC_GTEST_PROP(ChangedFieldsProperties, AreTheSameOfObjectsAndOfBytes, ()) {
  auto a = any<Rich>();
  auto b = any<Rich>();
  // Most of the fields are taken over, so that there is something alike.
  auto keep = *rc::gen::arbitrary<std::uint32_t>();
  std::size_t i = 0;
  for_each_field_pair(a, b, [&](const auto& x, const auto& y) {
    if ((keep >> i++) % 2 == 0)
      const_cast<std::remove_cvref_t<decltype(y)>&>(y) = x;
  });
  auto x = Value::of(a);
  auto y = Value::of(b);
  auto of_objects = changed_fields(x, y);
  RC_ASSERT(of_objects == changed_fields(opaque(x), opaque(y)));
  RC_ASSERT(of_objects == changed_fields(x, opaque(y)));
  RC_ASSERT((of_objects == 0) == (x == y));
}

RC_GTEST_PROP(ChangedFieldsProperties, AreTheFieldsWhoseBytesDiffer, ()) {
  Random random{*rc::gen::arbitrary<std::uint64_t>()};
  for (int i = 0; i < 50; ++i) {
    auto type = decode_descriptor(encode_descriptor(random_descriptor(random)));
    auto a = random_value(*type, random);
    auto b = random_value(*type, random);
    auto field = [](const RandomValue& x, std::size_t f) {
      auto begin = static_cast<std::ptrdiff_t>(f == 0 ? 0 : x.ends[f - 1]);
      return Bytes{x.bytes.begin() + begin,
                   x.bytes.begin() + static_cast<std::ptrdiff_t>(x.ends[f])};
    };
    FieldMask expected = 0;
    for (std::size_t f = 0; f < a.ends.size(); ++f)
      if (field(a, f) != field(b, f))
        expected |= field_bit(f);
    RC_ASSERT(changed_fields(Value::from_bytes(type, a.bytes), Value::from_bytes(type, b.bytes)) ==
              expected);
  }
}

RC_GTEST_PROP(EncodedSizeProperties, IsThatOfTheBytes, ()) {
  auto x = Value::of(any<Rich>());
  auto size = x.encoded_size();
  RC_ASSERT(size == x.bytes().size());
  RC_ASSERT(opaque(x).encoded_size() == size);
  auto y = any<SignedBox>();
  RC_ASSERT(encoded_size(y) == encode(y).size());
}

} // namespace castor::test
