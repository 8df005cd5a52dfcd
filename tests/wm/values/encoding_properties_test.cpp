#include "castor/wm/values/encoding.hpp"

#include "castor/wm/values/descriptor_encoding.hpp"
#include "castor/wm/values/field_access.hpp"
#include "castor/wm/values/json.hpp"
#include "castor/wm/values/value.hpp"

#include "castor/tests/wm/values/allocation_watch.hpp"
#include "castor/tests/wm/values/any_object.hpp"
#include "castor/tests/wm/values/random_values.hpp"
#include "castor/tests/wm/values/seeded_random.hpp"
#include "castor/tests/wm/values/test_types.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

namespace castor::test {

namespace {

/// Whatever a decoder does with bytes, it may ask for so much memory in total: every byte may
/// become an element of the largest type there is here, plus what messages and small containers
/// take.
std::size_t memory_limit(const Bytes& bytes) {
  return 1000 * bytes.size() + 100'000;
}

/// The bytes of some rich object, some of them damaged.
Bytes damaged(Bytes bytes, Random& random) {
  damage(bytes, random);
  return bytes;
}

TypeDescriptorPtr random_type(Random& random) {
  return decode_descriptor(encode_descriptor(random_descriptor(random)));
}

/// Whether `f` gives a value (or anything at all), rather than one of the errors that are allowed.
template <class F>
bool succeeds(F f) {
  try {
    f();
    return true;
  } catch (const DecodeError&) {
    return false;
  } catch (const FieldError&) {
    return false;
  }
}

/// Paths that lead somewhere or nowhere, and beyond what there is.
std::string random_path(Random& random) {
  std::string result;
  for (int i = between(random, 1, 4); i > 0; --i)
    result += (result.empty() ? "" : ".") + std::string(1, static_cast<char>('a' + random() % 6));
  return result;
}

/// Everything that can be asked of bytes and a descriptor that came from elsewhere.
void ask_everything(const TypeDescriptor& type, const Bytes& bytes, Random& random) {
  succeeds([&] { to_json(type, bytes); });
  succeeds([&] { to_json(type, bytes, {.indent = 1, .max_bytes = 2}); });
  succeeds([&] { read_field(type, bytes, random_path(random)); });
  for (auto& field : type.records.front().fields)
    succeeds([&] { read_field(type, bytes, field.name); });
  succeeds([&] {
    Decoder in{bytes};
    for (auto& field : type.records.front().fields)
      in.skip(type, field.type);
  });
}

} // namespace

RC_GTEST_PROP(EncodingProperties, ObjectsSurviveTheWire, ()) {
  auto x = any<Rich>();
  RC_ASSERT(decode<Rich>(encode(x)) == x);
  auto there = decode_self_described(encode_self_described(Value::of(x)));
  RC_ASSERT(*there.as<Rich>() == x);
}

RC_GTEST_PROP(EncodingProperties, BasesSurviveInsideDerivedValues, ()) {
  auto x = any<SignedBox>();
  auto there = decode_self_described(encode_self_described(Value::of(x)));
  RC_ASSERT(*there.as<Box>() == static_cast<const Box&>(x));
  RC_ASSERT(*there.as<PaintedBox>() == static_cast<const PaintedBox&>(x));
  RC_ASSERT(*there.as<SignedBox>() == x);
}

RC_GTEST_PROP(EncodingProperties, SkipLandsAfterEachFieldOfAnObject, ()) {
  auto x = any<Rich>();
  auto bytes = encode(x);
  auto& type = *descriptor_of<Rich>();
  Decoder in{bytes};
  std::size_t i = 0;
  for_each_field<Rich>(x, [&](std::string_view, const auto& member) {
    Bytes alone;
    Encoder{alone}.put(member);
    auto before = in.remaining();
    in.skip(type, type.records.front().fields[i++].type);
    RC_ASSERT(before - in.remaining() == alone.size());
  });
  RC_ASSERT(in.remaining() == 0u);
}

RC_GTEST_PROP(EncodingProperties, SkipLandsAfterEachFieldOfAnyType, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto type = random_type(random);
    auto value = random_value(*type, random);
    Decoder in{value.bytes};
    for (std::size_t f = 0; f < value.ends.size(); ++f) {
      in.skip(*type, type->records.front().fields[f].type);
      RC_ASSERT(value.bytes.size() - in.remaining() == value.ends[f]);
    }
    RC_ASSERT(in.remaining() == 0u);
  }
}

RC_GTEST_PROP(EncodingProperties, DamagedObjectsAreRefusedOrAreOthers, ()) {
  auto random = seeded();
  auto original = encode(any<Rich>());
  for (int i = 0; i < rounds; ++i) {
    auto bytes = damaged(original, random);
    AllocationWatch watch;
    std::optional<Rich> x;
    if (succeeds([&] { x = decode<Rich>(bytes); })) {
      auto again = encode(*x);
      RC_ASSERT(encode(decode<Rich>(again)) == again);
    } else {
      RC_ASSERT(watch.total() < memory_limit(bytes));
    }
  }
}

RC_GTEST_PROP(EncodingProperties, RandomBytesAreRefusedOrAreObjects, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto bytes = random_bytes(200, random);
    AllocationWatch watch;
    succeeds([&] { decode<Rich>(bytes); });
    succeeds([&] { decode<Tree>(bytes); });
    succeeds([&] { decode<SignedBox>(bytes); });
    RC_ASSERT(watch.total() < 3 * memory_limit(bytes));
  }
}

RC_GTEST_PROP(DescriptorProperties, DescriptorsSurviveTheWire, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto x = random_descriptor(random);
    auto bytes = encode_descriptor(x);
    auto y = *decode_descriptor(bytes);
    RC_ASSERT(encode_descriptor(y) == bytes);
    x.hash = y.hash;
    RC_ASSERT(x == y);
    RC_ASSERT(to_string(y).find(y.name()) == 0u);
  }
}

RC_GTEST_PROP(DescriptorProperties, DifferentDescriptorsHaveDifferentHashes, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto x = random_type(random);
    auto y = random_type(random);
    RC_ASSERT((encode_descriptor(*x) == encode_descriptor(*y)) == (x->hash == y->hash));
  }
}

RC_GTEST_PROP(DescriptorProperties, DamagedDescriptorsAreRefusedOrAreOthers, ()) {
  auto random = seeded();
  auto original = encode_descriptor(random_descriptor(random));
  int accepted = 0;
  for (int i = 0; i < rounds; ++i) {
    auto bytes = i % 5 == 0 ? random_bytes(100, random) : damaged(original, random);
    AllocationWatch watch;
    TypeDescriptorPtr type;
    bool is_descriptor = succeeds([&] { type = decode_descriptor(bytes); });
    RC_ASSERT(watch.total() < memory_limit(bytes));
    if (!is_descriptor)
      continue;
    ++accepted;
    RC_ASSERT(encode_descriptor(*type) == bytes);
    RC_ASSERT(!to_string(*type).empty());
    // What was accepted can be used.
    ask_everything(*type, random_bytes(100, random), random);
  }
  RC_CLASSIFY(accepted > 0);
}

RC_GTEST_PROP(DescriptorProperties, DamagedSelfDescribedValuesAreRefusedOrCanBePrinted, ()) {
  auto random = seeded();
  auto type = random_type(random);
  auto original = encode_self_described(Value::from_bytes(type, random_value(*type, random).bytes));
  RC_ASSERT(encode_self_described(decode_self_described(original)) == original);
  for (int i = 0; i < rounds; ++i) {
    auto bytes = i % 5 == 0 ? random_bytes(200, random) : damaged(original, random);
    AllocationWatch watch;
    Value x;
    bool is_value = succeeds([&] { x = decode_self_described(bytes); });
    RC_ASSERT(watch.total() < memory_limit(bytes));
    if (is_value) {
      RC_ASSERT(encode_self_described(x) == bytes);
      ask_everything(x.type(), x.bytes(), random);
    }
  }
}

RC_GTEST_PROP(DescriptorProperties, DamagedValuesOfAnyTypeAreRefusedOrPrinted, ()) {
  auto random = seeded();
  auto type = random_type(random);
  auto original = random_value(*type, random).bytes;
  for (int i = 0; i < rounds; ++i) {
    auto bytes = i % 5 == 0 ? random_bytes(200, random) : damaged(original, random);
    AllocationWatch watch;
    ask_everything(*type, bytes, random);
    RC_ASSERT(watch.total() < 4 * memory_limit(bytes));
  }
}

RC_GTEST_PROP(JsonProperties, SaysWhatTheValueOfAnyTypeHolds, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto type = random_type(random);
    auto value = random_value(*type, random);
    auto json = nlohmann::ordered_json::parse(to_json(*type, value.bytes));
    if (json != value.json)
      RC_FAIL(to_string(*type) + ": " + json.dump() + " instead of " + value.json.dump());
  }
}

RC_GTEST_PROP(JsonProperties, SaysWhatAnObjectHolds, ()) {
  auto x = any<Rich>();
  auto json = nlohmann::json::parse(to_json(Value::of(x)));
  RC_ASSERT(json["numbers"]["i64"].get<std::int64_t>() == x.numbers.i64);
  RC_ASSERT(json["numbers"]["u64"].get<std::uint64_t>() == x.numbers.u64);
  RC_ASSERT(json["numbers"]["f32"].get<float>() == x.numbers.f32);
  RC_ASSERT(json["numbers"]["f64"].get<double>() == x.numbers.f64);
  RC_ASSERT(json["table"].get<std::vector<std::vector<std::uint32_t>>>() == x.table);
  RC_ASSERT(json["doubles"].get<std::vector<double>>() == x.doubles);
  RC_ASSERT(json["flags"].get<std::vector<bool>>() == x.flags);
  RC_ASSERT(json["gaps"].size() == x.gaps.size());
  RC_ASSERT(json["nothings"].size() == x.nothings.size());
  RC_ASSERT(json["maybe_pose"].is_null() == !x.maybe_pose.has_value());
  RC_ASSERT(json["last"].get<std::uint32_t>() == x.last);
}

RC_GTEST_PROP(FieldProperties, FieldsOfAnyTypeAreFound, ()) {
  auto random = seeded();
  for (int i = 0; i < rounds; ++i) {
    auto type = random_type(random);
    auto value = random_value(*type, random);
    for (auto& [path, expected] : value.fields)
      if (read_field(*type, value.bytes, path) != expected)
        RC_FAIL(to_string(*type) + ": wrong value of " + path);
  }
}

RC_GTEST_PROP(FieldProperties, FieldsOfAnObjectAreFound, ()) {
  auto x = any<Rich>();
  auto& type = *descriptor_of<Rich>();
  auto bytes = encode(x);
  for_each_field<Numbers>(x.numbers, [&](std::string_view name, auto& member) {
    auto found = read_field(type, bytes, "numbers." + std::string{name});
    bool same = std::visit(
      [&](const auto& y) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(y)>>)
          return static_cast<long double>(y) == static_cast<long double>(member);
        else
          return false;
      },
      found);
    RC_ASSERT(same);
  });
  RC_ASSERT(read_field(type, bytes, "box.label") == FieldValue{x.box.label});
  RC_ASSERT(read_field(type, bytes, "tree.name") == FieldValue{x.tree.name});
  auto heading = read_field(type, bytes, "maybe_pose.heading");
  RC_ASSERT(heading == (x.maybe_pose ? FieldValue{x.maybe_pose->heading} : FieldValue{}));
}

RC_GTEST_PROP(FieldProperties, ComparisonsAgreeWithTheNumbers, ()) {
  // Few numbers, so that many are equal; all are exact as long double, the widest there is.
  auto pick = [] {
    return *rc::gen::element<FieldValue>(
      std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, std::numeric_limits<std::int64_t>::min(),
      std::numeric_limits<std::int64_t>::max(), std::uint64_t{0}, std::uint64_t{1},
      std::numeric_limits<std::uint64_t>::max(), std::uint64_t{1} << 63, -1.0, 0.0, 0.5, 1.0,
      9223372036854775808.0, -9223372036854775808.0, 18446744073709551616.0,
      std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN());
  };
  auto widest = [](const FieldValue& x) {
    return std::visit(
      [](const auto& v) -> long double {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(v)>>)
          return static_cast<long double>(v);
        else
          return 0;
      },
      x);
  };
  for (int i = 0; i < rounds; ++i) {
    auto a = pick();
    auto b = pick();
    auto x = widest(a);
    auto y = widest(b);
    RC_ASSERT(compare(a, Comparison::equal, b) == (x == y));
    RC_ASSERT(compare(a, Comparison::not_equal, b) == (x != y));
    RC_ASSERT(compare(a, Comparison::less, b) == (x < y));
    RC_ASSERT(compare(a, Comparison::less_equal, b) == (x <= y));
    RC_ASSERT(compare(a, Comparison::greater, b) == (x > y));
    RC_ASSERT(compare(a, Comparison::greater_equal, b) == (x >= y));
  }
}

RC_GTEST_PROP(FieldProperties, ComparisonsAgreeWithTheTexts, ()) {
  auto a = *rc::gen::container<std::string>(rc::gen::element('a', 'b', '\xff', '\0'));
  auto b = *rc::gen::container<std::string>(rc::gen::element('a', 'b', '\xff', '\0'));
  RC_ASSERT(compare(a, Comparison::equal, b) == (a == b));
  RC_ASSERT(compare(a, Comparison::less, b) == (a < b));
  RC_ASSERT(compare(a, Comparison::greater_equal, b) == (a >= b));
}

} // namespace castor::test
