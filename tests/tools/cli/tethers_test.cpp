// What `castor wm tether` makes of entries, and what it shows of a system that binds.

#include "castor/tests/tools/cli/castor_fixture.hpp"

#include "castor/tests/support/eventually.hpp"
#include "castor/tools/cli/tethers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <csignal>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using cli::Json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Json entry(const std::string& subarchitecture, const std::string& id, const std::string& type,
           const Json& value) {
  return {{"subarchitecture", subarchitecture}, {"id", id}, {"type", type}, {"value", value}};
}

Json pointer(const std::string& subarchitecture, const std::string& id, const std::string& type) {
  return {{"address", {{"subarchitecture", subarchitecture}, {"id", id}}}, {"type", type}};
}

Json feature(const std::string& kind, const std::string& text, bool negated = false) {
  return {{"kind", kind},
          {"text", text},
          {"numbers", Json::array()},
          {"data", pointer("", "", "")},
          {"negated", negated}};
}

Json tether(const std::string& subarchitecture, const std::string& id, const std::string& type) {
  auto result = feature("source_data", "");
  result["data"] = pointer(subarchitecture, id, type);
  return result;
}

Json port(const std::string& label, const std::string& proxy, const std::string& owner) {
  return {{"label", label}, {"proxy", proxy}, {"owner", owner}};
}

Json proxy(const std::string& id, const std::vector<Json>& features, const std::string& union_id,
           const std::vector<Json>& out_ports = {}) {
  return entry("binding", id, "BindingProxy",
               {{"features", features}, {"out_ports", out_ports}, {"union_id", union_id}});
}

Json bound(const std::string& id, const std::vector<Json>& features,
           const std::vector<std::string>& proxy_ids, const std::vector<Json>& out_ports = {}) {
  return entry("binding", id, "BindingUnion",
               {{"features", features}, {"out_ports", out_ports}, {"proxy_ids", proxy_ids}});
}

/// A ball that was seen and spoken of, a box that was seen only, and that the one is left of the
/// other.
class OfATable : public testing::Test {
protected:
  std::vector<Json> shown(const std::string& id) const {
    for (auto& x : entries)
      if (x["id"] == id)
        return cli::follow_tethers({x}, entries);
    return {};
  }

  std::string text(const std::string& id) const { return cli::tethers_as_text(shown(id)); }

  const std::vector<Json> ports{port("from", "v ball", "left"), port("to", "v box", "left")};
  const Json red = feature("colour", "red");

  std::vector<Json> entries{
    entry("vision", "0:1", "SceneObject",
          {{"time", 12},
           {"colour", {{"value", "red"}, {"confidence", 0.9}}},
           {"position", {{"x", 0.25}, {"y", -0.5}, {"z", -0.0}}},
           {"camera", ""},
           {"ball", {{"address", {{"subarchitecture", "vision"}, {"id", "0:7"}}}}}}),
    entry("vision", "0:2", "SceneObject", {{"time", 13}}),
    entry("vision", "0:3", "SceneObject", {{"time", 14}}),
    entry("speech", "w3", "Word", {{"text", "ball"}}),
    proxy("v ball",
          {red, feature("this_proxy_id", "v ball"), tether("vision", "0:1", "SceneObject")},
          "union 1"),
    proxy("s ball",
          {feature("concept_name", "ball"), feature("shape", "cube", true),
           tether("speech", "w3", "Word")},
          "union 1"),
    proxy("v box", {tether("vision", "0:2", "SceneObject")}, "union 2"),
    proxy("left", {feature("relation_label", "left")}, "union 3", ports),
    proxy("late", {tether("vision", "0:1", "SceneObject"), tether("vision", "0:9", "SceneObject")},
          ""),
    bound("union 1", {red, feature("concept_name", "ball"), red}, {"v ball", "s ball"}),
    bound("union 2", {}, {"v box"}),
    bound("union 3", {feature("relation_label", "left")}, {"left"}, ports)};
};

TEST_F(OfATable, AUnionHasProxiesAndTheseWhatTheyStandFor) {
  auto trees = shown("union 1");
  ASSERT_EQ(trees.size(), 1u);
  auto& proxies = trees[0]["proxies"];
  ASSERT_EQ(proxies.size(), 2u);
  EXPECT_EQ(proxies[0]["id"], "v ball");
  EXPECT_EQ(proxies[0]["data"][0], entries[0]);
  EXPECT_EQ(proxies[1]["id"], "s ball");
  EXPECT_EQ(proxies[1]["data"][0], entries[3]);
  EXPECT_FALSE(trees[0].contains("ends"));
}

TEST_F(OfATable, AnEntryHasProxiesAndTheseTheirUnionsWithEverybodyElse) {
  auto trees = shown("0:1");
  ASSERT_EQ(trees.size(), 1u);
  auto& proxies = trees[0]["proxies"];
  ASSERT_EQ(proxies.size(), 2u);
  EXPECT_EQ(proxies[0]["id"], "v ball");
  EXPECT_EQ(proxies[0]["union"]["id"], "union 1");
  ASSERT_EQ(proxies[0]["union"]["proxies"].size(), 1u);
  EXPECT_EQ(proxies[0]["union"]["proxies"][0]["id"], "s ball");
  EXPECT_EQ(proxies[0]["union"]["proxies"][0]["data"][0]["id"], "w3");
  EXPECT_EQ(proxies[1]["id"], "late");
  EXPECT_FALSE(proxies[1].contains("union"));
}

TEST_F(OfATable, AProxyHasBoth) {
  auto trees = shown("s ball");
  ASSERT_EQ(trees.size(), 1u);
  EXPECT_EQ(trees[0]["data"][0]["id"], "w3");
  EXPECT_EQ(trees[0]["union"]["id"], "union 1");
  EXPECT_EQ(trees[0]["union"]["proxies"][0]["id"], "v ball");
}

TEST_F(OfATable, ARelationHasEnds) {
  for (auto* id : {"left", "union 3"}) {
    auto trees = shown(id);
    ASSERT_EQ(trees.size(), 1u);
    auto& ends = trees[0]["ends"];
    ASSERT_EQ(ends.size(), 2u);
    EXPECT_EQ(ends[0]["label"], "from");
    EXPECT_EQ(ends[0]["proxy"], "v ball");
    EXPECT_EQ(ends[0]["union"]["id"], "union 1");
    EXPECT_EQ(ends[1]["union"]["id"], "union 2");
  }
}

TEST_F(OfATable, WhatIsNotThereIsGone) {
  auto data = shown("late")[0]["data"];
  ASSERT_EQ(data.size(), 2u);
  EXPECT_FALSE(data[0].contains("gone"));
  EXPECT_EQ(data[1]["id"], "0:9");
  EXPECT_EQ(data[1]["type"], "SceneObject");
  EXPECT_EQ(data[1]["gone"], true);
}

TEST_F(OfATable, WhatHasNoProxyIsLeftOut) {
  EXPECT_THAT(shown("0:3"), IsEmpty());
}

TEST_F(OfATable, TethersSayWhatToRead) {
  EXPECT_THAT(cli::tethered_subarchitectures(entries), ElementsAre("speech", "vision"));
  EXPECT_THAT(cli::tethered_types(entries), ElementsAre("speech/Word", "vision/SceneObject"));
  EXPECT_EQ(cli::unions_among(entries).size(), 3u);
}

TEST_F(OfATable, PeopleReadWhatTells) {
  EXPECT_EQ(
    text("union 1"),
    "binding/union 1  BindingUnion: colour red, concept name ball\n"
    "  binding/v ball  BindingProxy: colour red\n"
    "    vision/0:1  SceneObject: colour red (0.9), ball vision/0:7, position (0.25, -0.5, 0),"
    " time 12\n"
    "  binding/s ball  BindingProxy: concept name ball, not shape cube\n"
    "    speech/w3  Word: text ball\n");
}

TEST_F(OfATable, PeopleReadEndsOnce) {
  EXPECT_EQ(text("union 3"),
            "binding/union 3  BindingUnion: relation label left\n"
            "  from: binding/union 1  BindingUnion: colour red, concept name ball\n"
            "  to: binding/union 2  BindingUnion\n"
            "  binding/left  BindingProxy: relation label left\n");
}

TEST_F(OfATable, PeopleReadWhatIsMissing) {
  EXPECT_THAT(text("late"), HasSubstr("  vision/0:9  SceneObject: it is gone\n"
                                      "  it is in no union yet\n"));
}

TEST(Tethers, OfARelationMayLeadToWhatIsNotBound) {
  auto left = proxy("left", {}, "", {port("from", "v ball", "left")});
  auto trees = cli::follow_tethers({left}, {left});
  EXPECT_THAT(cli::tethers_as_text(trees), HasSubstr("  from: v ball, which is in no union\n"));
}

class TethersOfASystem : public Castor {
protected:
  static std::vector<nlohmann::json> tethers(std::vector<std::string> more) {
    more.insert(more.begin(), {"wm", "tether", "--json"});
    auto answer = ask(more);
    return answer.status == 0 ? json_lines(answer.output) : std::vector<nlohmann::json>{};
  }

  /// One that sees a table with things on it, and binds what it sees.
  std::string seeing() const {
    const std::string usual = "CPP WM SubarchitectureWorkingMemory\n"
                              "CPP TM AlwaysPositiveTaskManager\n";
    return write("seeing.cast", "COMPONENT CPP camera Camera --source scene:" CASTOR_CONFIGS
                                "/scenes/playmate.scene\n"
                                "SUBARCHITECTURE vision\n" +
                                  usual +
                                  "CPP UM change-detector ChangeDetector\n"
                                  "CPP MG segmentor Segmentor\n"
                                  "CPP MG feature-extractor FeatureExtractor\n"
                                  "CPP MG recogniser Recogniser\n"
                                  "CPP UM vision-monitor VisionBindingMonitor\n"
                                  "SUBARCHITECTURE binding\n" +
                                  usual +
                                  "CPP UM scorer BindingScorer\n"
                                  "CPP UM judge BindingJudge\n"
                                  "CPP UM binder Binder\n"
                                  "ACCESS vision WRITES binding\n");
  }
};

TEST_F(TethersOfASystem, AreFollowedInBothDirectionsOrItSaysWhyNot) {
  Process castor{command({"run", seeing()})};
  nlohmann::json object;
  ASSERT_TRUE(eventually([&] {
    for (auto& tree : tethers({}))
      for (auto& proxy : tree["proxies"])
        for (auto& data : proxy["data"])
          if (data["type"] == "SceneObject" && data["value"]["colour"]["value"] == "blue")
            object = data;
    return !object.is_null();
  }))
    << castor.errors();
  auto at = "vision/" + object["id"].get<std::string>();
  // The thing and its place, each bound.
  ASSERT_TRUE(eventually([&] {
    auto trees = tethers({at});
    return trees.size() == 1 && trees[0]["proxies"].size() == 2 &&
           trees[0]["proxies"][0].contains("union") && trees[0]["proxies"][1].contains("union");
  }))
    << ask({"wm", "tether", at}).output;
  auto text = ask({"wm", "tether", at}).output;
  EXPECT_THAT(text, HasSubstr("colour blue"));
  EXPECT_THAT(text, HasSubstr("binding/union of vision/object/"));
  EXPECT_THAT(ask({"wm", "tether", "binding/BindingProxy"}).output, HasSubstr("\n  to: binding/"));

  auto untethered = ask({"wm", "tether", "vision/ROI"});
  EXPECT_EQ(untethered.status, 2);
  EXPECT_THAT(untethered.errors,
              HasSubstr("no proxy is tethered to vision/ROI; proxies are tethered to entries of "
                        "vision/SceneObject"));
  EXPECT_THAT(ask({"wm", "tether", "vision/x"}).errors,
              HasSubstr("in vision there is neither an entry nor a type of the name x"));
  EXPECT_THAT(ask({"wm", "tether", "z/x"}).errors, HasSubstr("there is no subarchitecture z"));
}

TEST_F(TethersOfASystem, NeedBinding) {
  Process castor{command({"run", system("CPP UM ticker Ticker\n")})};
  ASSERT_TRUE(eventually([] { return ask({"ps"}).status == 0; })) << castor.errors();
  auto answer = ask({"wm", "tether"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, HasSubstr("there is no binding in this system"));
  EXPECT_THAT(answer.output, Not(HasSubstr("Binding")));
}

} // namespace

} // namespace castor::test
