#include "castor/actors/system/value_from_json.hpp"

#include "castor/tests/wm/values/random_values.hpp"
#include "castor/tests/wm/values/test_types.hpp"
#include "castor/wm/values/json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace castor::test {

namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

template <class T>
std::string refusal(const std::string& json) {
  try {
    value_from_json(descriptor_of<T>(), Json::parse(json));
  } catch (const ValueError& e) {
    return e.what();
  }
  return "(taken)";
}

const std::string pose = R"({"position": {"x": 1, "y": 2, "z": 3}, "heading": 0.5})";

TEST(ValueFromJson, IsTheInverseOfPrinting) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    Random random{seed};
    auto type = random_descriptor(random);
    auto value = random_value(type, random);
    auto text = to_json(type, value.bytes);
    auto again = value_from_json(std::make_shared<const TypeDescriptor>(type), Json::parse(text));
    EXPECT_EQ(to_json(again), text) << "seed " << seed;
  }
}

TEST(ValueFromJson, TakesEveryKindOfField) {
  Rich rich;
  rich.bytes = {1, 2, 255};
  rich.huge = Huge::all;
  rich.maybe_pose = Pose{};
  rich.tree = {"a", {{"b", {}}}};
  rich.box = signed_box();
  auto type = descriptor_of<Rich>();
  auto value = value_from_json(type, Json::parse(to_json(Value::of(rich))));
  EXPECT_EQ(*value.as<Rich>(), rich);
}

TEST(ValueFromJson, TakesItsOwnExamples) {
  auto type = descriptor_of<Rich>();
  auto example = example_of(*type);
  EXPECT_EQ(Json::parse(to_json(value_from_json(type, example))), example);
}

TEST(ValueFromJson, KeepsWhatIsNotGivenWhereThereIsABase) {
  auto base = Value::of(signed_box());
  auto value = value_from_json(
    base.type_ptr(), Json::parse(R"({"pose": {"position": {"y": 7}}, "signature": null})"), &base);
  auto expected = signed_box();
  expected.pose.position.y = 7;
  expected.signature.reset();
  EXPECT_EQ(*value.as<SignedBox>(), expected);
}

TEST(ValueFromJson, RefusesUnknownFieldsWithTheNearest) {
  EXPECT_THAT(refusal<Pose>(R"({"position": {"x": 1, "y": 2, "zz": 3}, "heading": 0})"),
              HasSubstr("Point has no field position.zz; did you mean 'z'?"));
  EXPECT_THAT(refusal<Nothing>(R"({"x": 1})"), HasSubstr("Nothing has no field x"));
}

TEST(ValueFromJson, RefusesMissingFieldsByTheirPath) {
  EXPECT_EQ(refusal<Pose>(R"({"position": {"x": 1}, "heading": 0})"),
            "position lacks the fields y, z of Point");
  EXPECT_EQ(refusal<Pose>(R"({"position": {"x": 1, "y": 2, "z": 3}})"),
            "the value lacks the field heading of Pose");
}

TEST(ValueFromJson, RefusesWrongKindsByTheirPath) {
  EXPECT_EQ(refusal<Pose>("3"),
            "the value has to be an object with the fields of Pose, but it is 3");
  EXPECT_EQ(refusal<Box>(R"({"label": 3, "pose": )" + pose + "}"),
            "label has to be a text, but it is 3");
  EXPECT_EQ(
    refusal<Tree>(R"({"name": "", "children": [{"name": "", "children": 1}]})"),
    "children[0].children has to be a list, each element an object of the type Tree, but it "
    "is 1");
}

template <class F>
std::string refused_change(const std::string& pointer, F value) {
  auto json = example_of(*descriptor_of<Rich>());
  json[Json::json_pointer{pointer}] = value;
  return refusal<Rich>(json.dump());
}

TEST(ValueFromJson, RefusesNumbersThatDoNotFit) {
  EXPECT_THAT(refused_change("/numbers/i8", 128), HasSubstr("between -128 and 127"));
  EXPECT_THAT(refused_change("/numbers/u8", -1), HasSubstr("between 0 and 255"));
  EXPECT_THAT(refused_change("/numbers/u64", -1), HasSubstr("but it is -1"));
  EXPECT_THAT(refused_change("/numbers/i32", 1.5), HasSubstr("an integer, but it is 1.5"));
  EXPECT_THAT(refused_change("/numbers/f32", 1e300), HasSubstr("too large"));
  EXPECT_THAT(refused_change("/numbers/truth", 1), HasSubstr("true or false"));
  EXPECT_THAT(refused_change("/triple", Json::array({1, 2})),
              HasSubstr("3 elements, but it has 2"));
}

TEST(ValueFromJson, RefusesUnknownEnumeratorsAndBrokenBytes) {
  EXPECT_THAT(refused_change("/side", "rihgt"), HasSubstr("did you mean 'right'?"));
  EXPECT_THAT(refused_change("/bytes", "***="), HasSubstr("base64"));
  EXPECT_THAT(refused_change("/bytes", Json{{"bytes", 10}}), HasSubstr("--full"));
}

TEST(ValueFromJson, RefusesWhatIsNestedTooDeeply) {
  std::string json = R"({"name": "", "children": []})";
  for (int i = 0; i < 200; ++i)
    json = R"({"name": "", "children": [)" + json + "]}";
  EXPECT_THAT(refusal<Tree>(json), HasSubstr("nested too deeply"));
}

} // namespace

} // namespace castor::test
