#include "castor/binding/binding_judge.hpp"

#include "castor/binding/binding_score.hpp"
#include "castor/tests/binding/proxies.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::binding::test {

namespace {

using Ids = std::vector<std::string>;

ProxyUnionScore scored(const std::string& union_id, std::uint32_t matches, double gap = 1e13) {
  ProxyUnionScore result{"p", union_id, {}};
  result.score.comparable = true;
  result.score.matches = matches;
  result.score.salience_gap = gap;
  return result;
}

ProxyUnionScore mismatch(const std::string& union_id) {
  auto result = scored(union_id, 3);
  result.score.mismatch = true;
  return result;
}

const ProxyUnionScore nil{"p", "", nil_score()};

TEST(BindingJudgement, TakesAllThatAreBest) {
  const std::vector<ProxyUnionScore> scores{scored("u1", 1), scored("u3", 2), mismatch("u4"),
                                            scored("u2", 2), nil};
  const auto best = judge("p", scores);
  EXPECT_EQ(best.unions, (Ids{"u2", "u3"}));
  EXPECT_TRUE(is_ambiguous(best, scores));
}

TEST(BindingJudgement, IsNilUnlessSomethingSpeaksForAUnion) {
  auto equal = nil;
  equal.union_id = "u3";
  const std::vector<ProxyUnionScore> scores{scored("u1", 0), mismatch("u2"), equal};
  EXPECT_TRUE(judge("p", scores).unions.empty());
  EXPECT_TRUE(judge("p", {}).unions.empty());
}

TEST(BindingJudgement, PrefersWhatIsSalient) {
  const std::vector<ProxyUnionScore> scores{scored("u1", 2), scored("u2", 2, 0)};
  const auto best = judge("p", scores);
  EXPECT_EQ(best.unions, (Ids{"u2", "u1"}));
  EXPECT_FALSE(is_ambiguous(best, scores));
}

TEST(Ambiguity, NamesWhatWouldDecide) {
  const auto proxy = proxy_from("comsys", {concept_of("ball"), shape("round"), not_from("comsys")});
  BindingUnion first;
  first.features = {concept_of("ball"), colour("red"), frame("perceived")};
  BindingUnion second;
  second.features = {concept_of("thing"), shape("round"), location_at(0, 0, 0, "table")};
  const BindingUnion* unions[] = {&first, &second};
  const BestUnionsForProxy best{"p", {"u1", "u2"}};
  const auto ambiguity = describe_ambiguity(best, proxy, unions, FeatureComparator{});
  EXPECT_EQ(ambiguity.unions, best.unions);
  EXPECT_EQ(ambiguity.missing_in_proxy, (std::vector{FeatureKind::colour, FeatureKind::location}));
  EXPECT_EQ(ambiguity.missing_in_unions, std::vector{FeatureKind::shape});
}

} // namespace

} // namespace castor::binding::test
