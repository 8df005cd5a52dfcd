#include "castor/wm/values/json.hpp"

#include "castor/tests/wm/values/one_kind_types.hpp"
#include "castor/tests/wm/values/test_types.hpp"
#include "castor/wm/values/encoding.hpp"
#include "castor/wm/values/value.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace castor::test {

namespace {

struct Maybes {
  std::optional<int> none;
  std::optional<int> some;
  std::optional<std::vector<int>> empty;
};
CASTOR_REFLECT(Maybes, none, some, empty)

struct Grid {
  std::vector<std::vector<int>> rows;
  std::array<bool, 2> flags{};
};
CASTOR_REFLECT(Grid, rows, flags)

template <class T>
std::string json_of(const T& x, const JsonOptions& options = {}) {
  return to_json(*descriptor_of<T>(), encode(x), options);
}

} // namespace

TEST(Json, KeepsTheOrderOfTheFields) {
  EXPECT_EQ(json_of(signed_box()),
            R"({"label":"tea","pose":{"position":{"x":1.5,"y":-2.25,"z":0.5},"heading":3.0},)"
            R"("colours":["red","","green"],"side":"right","signature":"Nick"})");
}

TEST(Json, PrintsAStructWithoutFieldsAsAnEmptyObject) {
  EXPECT_EQ(json_of(Nothing{}), "{}");
}

TEST(Json, PrintsTheExtremesOfIntegersExactly) {
  Numbers x;
  x.i64 = std::numeric_limits<std::int64_t>::min();
  x.u64 = std::numeric_limits<std::uint64_t>::max();
  x.i8 = -128;
  x.u8 = 255;
  auto json = json_of(x);
  EXPECT_THAT(json, testing::HasSubstr(R"("i64":-9223372036854775808)"));
  EXPECT_THAT(json, testing::HasSubstr(R"("u64":18446744073709551615)"));
  EXPECT_THAT(json, testing::HasSubstr(R"("i8":-128)"));
  EXPECT_THAT(json, testing::HasSubstr(R"("u8":255)"));
  EXPECT_THAT(json, testing::HasSubstr(R"("truth":false)"));
}

TEST(Json, PrintsNumbersThatJsonLacksAsNull) {
  Point x{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
          -std::numeric_limits<float>::infinity()};
  EXPECT_EQ(json_of(x), R"({"x":null,"y":null,"z":null})");
}

TEST(Json, PrintsDoublesSoThatTheyReadBackTheSame) {
  Point x{0.1, std::numeric_limits<double>::max(), 0.1f};
  auto json = nlohmann::json::parse(json_of(x));
  EXPECT_EQ(json["x"].get<double>(), x.x);
  EXPECT_EQ(json["y"].get<double>(), x.y);
  EXPECT_EQ(json["z"].get<float>(), x.z);
}

TEST(Json, PrintsEnumeratorsByName) {
  EXPECT_EQ(json_of(Chosen{Side::both, Trend::falling, Huge::all}),
            R"({"side":"both","trend":"falling","huge":"all"})");
}

TEST(Json, PrintsTheNumberOfAnEnumeratorWithoutAName) {
  EXPECT_EQ(json_of(Chosen{static_cast<Side>(8), static_cast<Trend>(-6),
                           static_cast<Huge>(0xfffffffffffffffe)}),
            R"({"side":"8","trend":"-6","huge":"18446744073709551614"})");
}

TEST(Json, PrintsAbsentOptionalsAsNullAndEmptyOnesAsEmpty) {
  EXPECT_EQ(json_of(Maybes{std::nullopt, 3, std::vector<int>{}}),
            R"({"none":null,"some":3,"empty":[]})");
}

TEST(Json, PrintsNestedListsAndArrays) {
  EXPECT_EQ(json_of(Grid{{{}, {1}, {2, 3}}, {true, false}}),
            R"({"rows":[[],[1],[2,3]],"flags":[true,false]})");
}

TEST(Json, PrintsRecursiveTypes) {
  EXPECT_EQ(json_of(Tree{"a", {{"b", {}}, {"c", {{"d", {}}}}}}),
            R"({"name":"a","children":[{"name":"b","children":[]},)"
            R"({"name":"c","children":[{"name":"d","children":[]}]}]})");
}

TEST(Json, PrintsBytesAsBase64) {
  // The test vectors of RFC 4648, section 10, and the two digits that are neither letter nor
  // number.
  for (auto [plain, coded] :
       std::initializer_list<std::pair<std::string, std::string>>{{"", ""},
                                                                  {"f", "Zg=="},
                                                                  {"fo", "Zm8="},
                                                                  {"foo", "Zm9v"},
                                                                  {"foob", "Zm9vYg=="},
                                                                  {"fooba", "Zm9vYmE="},
                                                                  {"foobar", "Zm9vYmFy"},
                                                                  {"\xfb\xff\xfe", "+//+"}})
    EXPECT_EQ(json_of(Blob{{plain.begin(), plain.end()}}), R"({"data":")" + coded + R"("})");
}

TEST(Json, PrintsTheSizeOfBytesBeyondTheLimit) {
  Blob x{{1, 2, 3}};
  EXPECT_EQ(json_of(x, {.max_bytes = 2}), R"({"data":{"bytes":3}})");
  EXPECT_EQ(json_of(x, {.max_bytes = 3}), R"({"data":"AQID"})");
  EXPECT_EQ(json_of(x, {.max_bytes = 0}), R"({"data":{"bytes":3}})");
  EXPECT_EQ(json_of(Blob{}, {.max_bytes = 0}), R"({"data":""})");
}

TEST(Json, PrintsTextThatIsNoUtf8) {
  auto text = json_of(Text{"a\xff\xc3z"});
  EXPECT_EQ(nlohmann::json::parse(text)["s"], "a\xef\xbf\xbd\xef\xbf\xbdz");
}

TEST(Json, EscapesWhatJsonNeedsEscaped) {
  std::string text{"\"\\\n\0\x1f/\xc3\xa9", 8};
  EXPECT_EQ(nlohmann::json::parse(json_of(Text{text}))["s"], text);
}

TEST(Json, IndentsWhereAsked) {
  EXPECT_EQ(json_of(Text{"a"}, {.indent = 2}), "{\n  \"s\": \"a\"\n}");
}

TEST(Json, PrintsAValueOfWhicheverOrigin) {
  auto here = Value::of(Text{"a"});
  EXPECT_EQ(to_json(here), R"({"s":"a"})");
  EXPECT_EQ(to_json(Value::from_bytes(here.type_ptr(), here.bytes())), R"({"s":"a"})");
  EXPECT_EQ(to_json(here, {.indent = 0}), "{\n\"s\": \"a\"\n}");
}

TEST(Json, RefusesTruncatedBytes) {
  auto x = signed_box();
  auto bytes = encode(x);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(to_json(*descriptor_of<SignedBox>(), std::span{bytes}.first(n)), DecodeError);
}

TEST(Json, RefusesBytesThatTheDescriptorDoesNotExplain) {
  auto& type = *descriptor_of<Integers>();
  EXPECT_THROW(to_json(type, Bytes{4, 0, 0, 0, 0, 0, 0, 0, 9}), DecodeError);
  EXPECT_THROW(to_json(type, Bytes{5, 0, 0, 0, 0, 0, 0, 0, 9}), DecodeError);
  auto pose = encode(Pose{});
  pose[0] = 21;
  pose.insert(pose.begin() + 24, 0);
  EXPECT_THROW(to_json(*descriptor_of<Pose>(), pose), DecodeError);
}

TEST(Json, RefusesAListThatClaimsMoreThanItHas) {
  EXPECT_THROW(
    to_json(*descriptor_of<Integers>(), Bytes{8, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 1, 0, 0, 0}),
    DecodeError);
}

TEST(Json, PrintsAnyNumberOfRecordsSideBySide) {
  Tree tree{"root", {}};
  tree.children.resize(1000);
  EXPECT_EQ(nlohmann::json::parse(json_of(tree))["children"].size(), 1000u);
}

TEST(Json, RefusesDeepNesting) {
  Tree tree{"leaf", {}};
  for (int i = 0; i < 200; ++i) {
    Tree parent{"node", {}};
    parent.children.push_back(std::move(tree));
    tree = std::move(parent);
  }
  EXPECT_THAT([&] { json_of(tree); },
              testing::ThrowsMessage<DecodeError>(testing::HasSubstr("nested too deeply")));
}

} // namespace castor::test
