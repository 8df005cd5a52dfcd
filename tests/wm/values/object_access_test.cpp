#include "castor/wm/values/object_access.hpp"

#include "castor/wm/values/value.hpp"

#include "castor/tests/wm/filters/random_predicates.hpp"
#include "castor/tests/wm/values/allocation_watch.hpp"
#include "castor/tests/wm/values/any_object.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace castor::test {

namespace {

/// Calls `f` with the path of every field that leads through records and optionals only.
template <class F>
void for_each_path(const TypeDescriptor& type, std::uint32_t record, const std::string& prefix,
                   F&& f, int depth = 0) {
  for (auto& field : type.records[record].fields) {
    auto path = prefix + field.name;
    f(path);
    auto place = find_field(type, path);
    if (place.type->kind == WireKind::record && depth < 3)
      for_each_path(type, place.type->index, path + '.', f, depth + 1);
  }
}

} // namespace

TEST(ObjectAccess, ReadsFieldsWithoutEncodingTheRest) {
  Rich x;
  x.bytes.resize(10'000'000);
  x.last = 7;
  x.box = signed_box();
  auto value = Value::of(std::move(x));
  auto& type = *descriptor_of<Rich>();
  auto last = find_field(type, "last").path;
  auto side = find_field(type, "box.side").path;
  AllocationWatch watch;
  EXPECT_EQ(value.field(last), FieldValue{std::uint64_t{7}});
  EXPECT_EQ(value.field(side), FieldValue{"right"});
  EXPECT_EQ(value.encoded_size(), value.encoded_size());
  EXPECT_LT(watch.total(), 10'000u);
}

TEST(ObjectAccess, ComparesObjectsWithoutEncodingThem) {
  Rich x;
  x.bytes.resize(10'000'000);
  auto y = x;
  y.last = 1;
  auto before = Value::of(std::move(x));
  auto after = Value::of(std::move(y));
  auto predicate = Predicate::parse("last == 1 && box.side != \"right\"");
  AllocationWatch watch;
  EXPECT_EQ(changed_fields(before, after), field_bit(*descriptor_of<Rich>(), "last"));
  EXPECT_TRUE(predicate.matches(after));
  EXPECT_LT(watch.total(), 100'000u);
}

TEST(ObjectAccess, ReadsElementsOfArrays) {
  Thing x;
  x.spot = {3, 4};
  auto path = find_field(*descriptor_of<Thing>(), "spot").path;
  path.push_back(1);
  auto value = Value::of(x);
  EXPECT_EQ(value.field(path), FieldValue{4.0});
  EXPECT_EQ(Value::from_bytes(value.type_ptr(), value.bytes()).field(path), FieldValue{4.0});
}

RC_GTEST_PROP(ObjectAccessProperties, FindsInObjectsWhatIsInTheBytes, ()) {
  auto x = Value::of(any<Rich>());
  auto far = decode_self_described(encode_self_described(x));
  int single = 0;
  for_each_path(x.type(), 0, "", [&](const std::string& path) {
    auto place = find_field(x.type(), path);
    RC_ASSERT(x.has_field(place.path) == far.has_field(place.path));
    if (!is_single(place.type->kind))
      return;
    ++single;
    auto found = x.field(place.path);
    // NaN equals nothing.
    if (!std::holds_alternative<double>(found))
      RC_ASSERT(found == far.field(place.path));
    RC_ASSERT(compare(found, Comparison::equal, far.field(place.path)) ==
              compare(found, Comparison::equal, found));
    RC_ASSERT(std::holds_alternative<std::monostate>(found) == !x.has_field(place.path));
  });
  RC_ASSERT(single > 25);
}

RC_GTEST_PROP(NormalisedProperties, EqualNumbersAreTheSame, ()) {
  auto pick = [] {
    return *rc::gen::element<FieldValue>(
      std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, std::numeric_limits<std::int64_t>::min(),
      std::numeric_limits<std::int64_t>::max(), std::uint64_t{0}, std::uint64_t{1},
      std::numeric_limits<std::uint64_t>::max(), std::uint64_t{1} << 63, -1.0, 0.0, -0.0, 0.5, 1.0,
      9223372036854775808.0, -9223372036854775808.0, 18446744073709551616.0, 18446744073709549568.0,
      9007199254740992.0, std::int64_t{9007199254740993}, std::numeric_limits<double>::infinity());
  };
  auto a = pick();
  auto b = pick();
  RC_ASSERT((normalised(a) == normalised(b)) == compare(a, Comparison::equal, b));
  RC_ASSERT(compare(a, Comparison::equal, normalised(a)));
}

} // namespace castor::test
