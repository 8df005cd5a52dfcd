#include "castor/tests/binding/reference/binding_core.hpp"

#include "castor/tests/binding/proxies.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace castor::binding::test {

namespace {

using Ids = std::vector<std::string>;

class Binding : public ::testing::Test {
protected:
  void see(const std::string& id, std::vector<Feature> features) {
    features.push_back(not_from("vision"));
    core.set(id, proxy_from("vision", std::move(features)));
  }

  void hear(const std::string& id, std::vector<Feature> features) {
    features.push_back(not_from("comsys"));
    core.set(id, with_precedence(proxy_from("comsys", std::move(features)), 1));
  }

  BindingCore core;
};

TEST_F(Binding, TakesTheBestUnion) {
  see("v1", {concept_of("thing")});
  see("v2", {concept_of("thing"), colour("red")});
  hear("c", {concept_of("ball"), colour("red")});
  EXPECT_EQ(core.union_of("c"), core.union_of("v2"));
  EXPECT_EQ(core.ambiguity("c"), std::nullopt);
}

TEST_F(Binding, ChangesItsMindWithTheFeatures) {
  see("v1", {concept_of("thing")});
  hear("c", {concept_of("ball"), colour("red")});
  EXPECT_EQ(core.union_of("c"), core.union_of("v1"));
  see("v1", {concept_of("thing"), colour("blue")});
  EXPECT_EQ(core.union_of("c"), "union of c");
  see("v2", {concept_of("ball")});
  EXPECT_EQ(core.union_of("c"), core.union_of("v2"));
  see("v1", {concept_of("thing"), colour("red")});
  EXPECT_EQ(core.union_of("c"), core.union_of("v1"));
  core.remove("v1");
  EXPECT_EQ(core.union_of("c"), core.union_of("v2"));
}

TEST_F(Binding, SaysWhatIsAmbiguous) {
  see("v1", {concept_of("thing"), colour("red")});
  see("v2", {concept_of("thing"), colour("blue")});
  hear("c", {concept_of("ball")});
  EXPECT_EQ(core.union_of("c"), "union of v1");
  EXPECT_EQ(core.best_unions("c").unions, (Ids{"union of v1", "union of v2"}));
  const auto ambiguity = core.ambiguity("c");
  ASSERT_TRUE(ambiguity);
  EXPECT_EQ(ambiguity->unions, (Ids{"union of v1", "union of v2"}));
  EXPECT_EQ(ambiguity->missing_in_proxy, std::vector{FeatureKind::colour});
  EXPECT_TRUE(ambiguity->missing_in_unions.empty());
  // The answer to "the red one or the blue one?"
  hear("c", {concept_of("ball"), colour("blue")});
  EXPECT_EQ(core.union_of("c"), "union of v2");
  EXPECT_EQ(core.ambiguity("c"), std::nullopt);
}

TEST_F(Binding, TakesWhatIsPointedAt) {
  see("v1", {concept_of("thing")});
  see("v2", {concept_of("thing"), salient_from(1000, 2000)});
  hear("c", {concept_of("ball"), created_at(1500)});
  EXPECT_EQ(core.union_of("c"), "union of v2");
  EXPECT_EQ(core.ambiguity("c"), std::nullopt);
}

TEST_F(Binding, TellsAlikeThingsApartByTheirRelations) {
  for (const auto* id : {"v1", "v2"})
    see(id, {concept_of("thing"), colour("red")});
  see("v3", {concept_of("ball")});
  core.set("vr", relation_from("spatial", "left", "v2", "v3"));
  hear("c1", {concept_of("thing"), colour("red")});
  EXPECT_EQ(core.union_of("c1"), "union of v1");
  hear("c2", {concept_of("ball"), not_from("nobody")});
  core.set("cr", with_precedence(relation_from("comsys", "left", "c1", "c2"), 1));
  EXPECT_EQ(core.union_of("c1"), "union of v2");
  EXPECT_EQ(core.union_of("c2"), "union of v3");
  EXPECT_EQ(core.union_of("cr"), core.union_of("vr"));
  core.remove("cr");
  EXPECT_EQ(core.union_of("c1"), "union of v1");
}

// What follows took some ten thousand random runs to be noticed.

TEST_F(Binding, ForgetsChoicesThatHaveBecomeOne) {
  core.set("a1", proxy_from("vision", {concept_of("box"), shape("round")}));
  core.set("a2", proxy_from("vision", {colour("red")}));
  core.set("b", proxy_from("vision", {concept_of("ball"), colour("red"), shape("round")}));
  core.set("c", proxy_from("vision", {shape("round")}));
  EXPECT_EQ(core.best_unions("c").unions, (Ids{"union of a1", "union of a2"}));
  core.set("a0", proxy_from("vision", {colour("red")}));
  EXPECT_EQ(core.best_unions("c").unions, (Ids{"union of a0", "union of a1"}));
}

TEST_F(Binding, CountsRelationsOnceSomebodyMakesThemComparable) {
  const auto here = location_at(0, 0, 0, "table");
  core.set("far", proxy_from("vision", {concept_of("ball")}));
  core.set("r1", relation_from("vision", "left", "a", "far"));
  core.set("r2", relation_from("comsys", "left", "c", "far"));
  core.set("a", proxy_from("vision", {here}));
  core.set("c", proxy_from("comsys", {colour("red")}));
  EXPECT_EQ(core.union_of("c"), "union of c");
  core.set("b", proxy_from("spatial", {here, colour("unknown")}));
  EXPECT_EQ(core.union_of("c"), "union of a");
}

TEST_F(Binding, CountsRelationsOfThoseWhoJoinWhatIsComparable) {
  const auto here = location_at(0, 0, 0, "table");
  core.set("far", proxy_from("vision", {concept_of("ball")}));
  core.set("r1", relation_from("vision", "left", "b", "far"));
  core.set("r2", relation_from("comsys", "left", "c", "far"));
  core.set("a", proxy_from("vision", {here, colour("unknown")}));
  core.set("c", proxy_from("comsys", {colour("red")}));
  EXPECT_EQ(core.union_of("c"), "union of c");
  core.set("b", proxy_from("spatial", {here}));
  EXPECT_EQ(core.union_of("c"), "union of a");
}

TEST_F(Binding, WaitsForAnswersOfOthers) {
  FeatureComparisonCompetence coma;
  coma.subarchitecture = "coma";
  core.add(coma);
  see("v1", {concept_of("mug")});
  hear("c", {concept_of("cup")});
  EXPECT_EQ(core.union_of("c"), "union of c");
  const auto open = core.open_comparisons("c");
  ASSERT_EQ(open.size(), 1u);
  const auto change = core.answer(open[0].proxy_feature, open[0].union_feature, Truth::yes);
  EXPECT_EQ(change.changed, Ids{"union of v1"});
  EXPECT_EQ(change.removed, Ids{"union of c"});
  EXPECT_EQ(change.moved, Ids{"c"});
  EXPECT_TRUE(core.open_comparisons("c").empty());
}

TEST_F(Binding, DoesNothingForWhatStaysAsItWas) {
  see("v1", {concept_of("thing")});
  const auto before = core.unions();
  see("v1", {concept_of("thing")});
  EXPECT_EQ(core.unions(), before);
  const auto change = core.remove("nobody");
  EXPECT_TRUE(change.changed.empty() && change.removed.empty() && change.moved.empty());
  EXPECT_EQ(core.union_of("nobody"), "");
  EXPECT_TRUE(core.best_unions("nobody").unions.empty());
}

} // namespace

} // namespace castor::binding::test
