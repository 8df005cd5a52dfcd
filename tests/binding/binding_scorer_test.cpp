#include "castor/binding/binding_scorer.hpp"

#include "castor/binding/binding_score.hpp"
#include "castor/tests/binding/proxies.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace castor::binding::test {

namespace {

BindingScore score_of(std::uint32_t matches, std::uint32_t relation_matches = 0,
                      std::uint32_t sticky = 0) {
  BindingScore result;
  result.comparable = true;
  result.matches = matches;
  result.relation_matches = relation_matches;
  result.sticky = sticky;
  return result;
}

class Scorer : public ::testing::Test {
protected:
  BindingScore score(const std::string& id, const std::vector<std::string>& members) const {
    return BindingScorer{comparator}.score(memory.ref(id), memory.refs(members), memory);
  }

  void add(const std::string& id, std::vector<Feature> features,
           const std::string& source = "vision") {
    tell(memory, id, proxy_from(source, std::move(features)));
  }

  FeatureComparator comparator;
  BindingView memory;
};

TEST(BindingScore, IsOrderedLexicographically) {
  auto mismatch = score_of(5, 5, 5);
  mismatch.mismatch = true;
  auto relation_mismatch = score_of(5, 5, 5);
  relation_mismatch.relation_mismatch = true;
  auto incomparable = score_of(5, 5, 5);
  incomparable.comparable = false;
  const BindingScore ascending[] = {incomparable,   mismatch,      relation_mismatch,
                                    score_of(0),    nil_score(),   score_of(0, 0, 2),
                                    score_of(0, 1), score_of(1),   score_of(1, 0, 1),
                                    score_of(1, 1), score_of(2, 0)};
  for (std::size_t i = 0; i < std::size(ascending); ++i) {
    for (std::size_t j = 0; j < std::size(ascending); ++j)
      EXPECT_EQ(beats(ascending[i], ascending[j]), i > j) << i << ", " << j;
  }
  auto salient = score_of(1);
  salient.salience_gap = 0;
  EXPECT_EQ(compare(salient, score_of(1)), std::strong_ordering::equal);
}

TEST_F(Scorer, CountsEachKindOfFeatureOnce) {
  add("a", {concept_of("thing"), colour("red")});
  add("b", {concept_of("ball"), colour("red"), shape("round")});
  add("c", {concept_of("thing"), concept_of("ball"), colour("red"), shape("unknown")});
  EXPECT_EQ(score("c", {"a", "b"}), score_of(2));
}

TEST_F(Scorer, CountsNothingForWhatIsUnknown) {
  add("a", {colour("unknown")});
  add("b", {colour("red")});
  EXPECT_EQ(score("b", {"a"}), score_of(0));
  EXPECT_TRUE(beats(nil_score(), score("b", {"a"})));
}

TEST_F(Scorer, NeverBindsWhatExcludesEachOther) {
  add("a", {concept_of("thing"), colour("red")});
  add("b", {concept_of("thing"), negation_of(colour("red"))});
  add("c", {concept_of("thing"), frame("perceived")});
  add("d", {concept_of("thing"), frame("desired")});
  add("e", {concept_of("thing"), not_from("vision")});
  EXPECT_TRUE(score("b", {"a"}).mismatch);
  EXPECT_TRUE(score("d", {"a", "c"}).mismatch);
  EXPECT_TRUE(score("e", {"a"}).mismatch);
  // Whoever says so.
  add("f", {concept_of("thing")});
  EXPECT_TRUE(score("f", {"e"}).mismatch);
  add("g", {concept_of("thing")}, "comsys");
  EXPECT_EQ(score("g", {"e"}), score_of(1));
}

TEST_F(Scorer, DoesNotCountDenialsAsMatches) {
  add("a", {colour("blue")});
  add("b", {negation_of(colour("red"))});
  EXPECT_EQ(score("b", {"a"}), score_of(0));
}

TEST_F(Scorer, DoesNotCompareWhatIsOfAnotherType) {
  add("a", {concept_of("thing")});
  add("b", {concept_of("thing")});
  auto group = proxy_from("vision", {concept_of("thing")});
  group.type = ProxyType::group;
  tell(memory, "c", group);
  EXPECT_FALSE(score("c", {"a"}).comparable);
  add("d", {location_at(0, 0, 0, "table")});
  EXPECT_FALSE(score("d", {"a"}).comparable);
}

TEST_F(Scorer, LooksOnlyAtThoseBefore) {
  add("a", {concept_of("thing")});
  add("b", {concept_of("thing")});
  EXPECT_FALSE(score("a", {"b"}).comparable);
  EXPECT_EQ(score("b", {"a"}), score_of(1));
  tell(memory, "a", with_precedence(proxy_from("comsys", {concept_of("thing")}), 1));
  EXPECT_EQ(score("a", {"b"}), score_of(1));
}

TEST_F(Scorer, OrdersEqualsBySalience) {
  add("a", {concept_of("thing"), salient_from(10, 20)});
  add("b", {concept_of("thing"), salient_from(30)});
  add("c", {concept_of("thing"), created_at(5)});
  add("d", {concept_of("thing"), created_at(25)}, "comsys");
  EXPECT_EQ(score("d", {"a"}).salience_gap, 5);
  EXPECT_EQ(score("d", {"b"}).salience_gap, 5);
  EXPECT_EQ(score("d", {"c"}).salience_gap, BindingScore{}.salience_gap);
  add("e", {concept_of("thing"), created_at(31)}, "comsys");
  EXPECT_EQ(score("e", {"b"}).salience_gap, 0);
}

class RelationScorer : public Scorer {
protected:
  RelationScorer() {
    // v1 is left of v2, and c1 of c2.
    add("v1", {concept_of("thing")});
    add("v2", {concept_of("ball")});
    add("v3", {concept_of("thing")});
    tell(memory, "vr", relation_from("vision", "left", "v1", "v2"));
    tell(memory, "x1", with_precedence(proxy_from("comsys", {concept_of("thing")}), 1));
    tell(memory, "x2", with_precedence(proxy_from("comsys", {concept_of("ball")}), 1));
    tell(memory, "xr", with_precedence(relation_from("comsys", "left", "x1", "x2"), 1));
  }
};

TEST_F(RelationScorer, PrefersWhatIsRelatedAlike) {
  EXPECT_EQ(score("x1", {"v1"}), score_of(1, 1));
  EXPECT_EQ(score("x1", {"v3"}), score_of(1, 0));
  // As "from" and as "to" are different things.
  EXPECT_EQ(score("x1", {"v2"}), score_of(1, 0));
}

TEST_F(RelationScorer, GoesByWhatBecameOfThoseBefore) {
  // x1 comes before x2.
  EXPECT_EQ(score("x2", {"v2"}), score_of(1, 0));
  bind_together(memory, union_id_of("v1"), {"v1", "x1"});
  EXPECT_EQ(score("x2", {"v2"}), score_of(1, 1));
}

TEST_F(RelationScorer, DoesNotCountAnotherRelation) {
  tell(memory, "vr", relation_from("vision", "right", "v1", "v2"));
  EXPECT_EQ(score("x1", {"v1"}), score_of(1, 0));
}

TEST_F(RelationScorer, ComparesRelationsByTheirEnds) {
  EXPECT_EQ(score("xr", {"vr"}), score_of(1, 0));
  bind_together(memory, union_id_of("v1"), {"v1", "x1"});
  EXPECT_EQ(score("xr", {"vr"}), score_of(1, 1));
  bind_together(memory, union_id_of("v2"), {"v2", "x2"});
  EXPECT_EQ(score("xr", {"vr"}), score_of(1, 2));
}

TEST_F(RelationScorer, SeparatesRelationsWhoseEndsExcludeEachOther) {
  tell(memory, "x2", with_precedence(proxy_from("comsys", {concept_of("box")}), 1));
  EXPECT_TRUE(score("xr", {"vr"}).relation_mismatch);
  // Not by what they say themselves, but by what they are bound with.
  tell(memory, "x2", with_precedence(proxy_from("comsys", {concept_of("thing")}), 1));
  EXPECT_FALSE(score("xr", {"vr"}).relation_mismatch);
  add("v4", {concept_of("box")});
  bind_together(memory, union_id_of("v4"), {"v4", "x2"});
  EXPECT_TRUE(score("xr", {"vr"}).relation_mismatch);
}

TEST_F(RelationScorer, SeparatesRelationsWithOtherEnds) {
  auto other = relation_from("comsys", "left", "x1", "x2");
  other.out_ports[1].label = "beside";
  tell(memory, "xr", with_precedence(other, 1));
  EXPECT_TRUE(score("xr", {"vr"}).relation_mismatch);
  other.out_ports.pop_back();
  tell(memory, "xr", with_precedence(other, 1));
  EXPECT_TRUE(score("xr", {"vr"}).relation_mismatch);
}

TEST_F(RelationScorer, DoesNotMindWhatIsNotThereYet) {
  tell(memory, "xr", with_precedence(relation_from("comsys", "left", "nobody", "nowhere"), 1));
  EXPECT_EQ(score("xr", {"vr"}), score_of(1, 0));
}

TEST_F(Scorer, SaysWhatOthersShouldBeAsked) {
  FeatureComparisonCompetence coma;
  coma.subarchitecture = "coma";
  comparator.add(coma);
  const auto toy = proxy_from("vision", {concept_of("toy"), colour("red")});
  const auto ball = proxy_from("comsys", {concept_of("ball"), colour("blue")});
  const auto open = BindingScorer{comparator}.open_comparisons(toy, ball);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].proxy_feature, concept_of("toy"));
  EXPECT_EQ(open[0].union_feature, concept_of("ball"));
  EXPECT_FALSE(open[0].answered);
  comparator.answer(open[0].proxy_feature, open[0].union_feature, Truth::unknown);
  EXPECT_TRUE((BindingScorer{comparator}.open_comparisons(toy, ball).empty()));
}

} // namespace

} // namespace castor::binding::test
