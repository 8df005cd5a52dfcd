// The run of section 5.1.3 of the paper: the PlayMate is shown a blue square, and told that "this
// is a blue square".
#include "castor/binding/binding_score.hpp"
#include "castor/tests/binding/proxies.hpp"
#include "castor/tests/binding/reference/binding_core.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding::test {

namespace {

using Members = std::vector<std::vector<std::string>>;

std::vector<std::pair<std::string, BindingProxy>> proxies_of_the_run() {
  const auto tether = tether_to({{"vision", "0:1"}, "SceneObject"});
  const auto perceived = frame("perceived");
  auto relation = relation_from("vision", "pos", "P2", "P1");
  relation.features.insert(relation.features.end(), {perceived, not_from("vision")});
  return {
    {"P1", proxy_from("vision", {concept_of("thing"), tether, perceived, not_from("vision")})},
    {"P2",
     proxy_from("vision", {location_at(0.30, 0.10, 0.02, "table"), perceived, not_from("vision")})},
    {"P3", relation},
    {"P4", proxy_from("spatial",
                      {location_at(0.31, 0.10, 0.02, "table"), perceived, not_from("spatial")})},
    {"P4'", proxy_from("spatial", {location_at(0.31, 0.10, 0.02, "table"), frame("desired"),
                                   not_from("spatial")})},
    {"P5", with_precedence(proxy_from("comsys", {concept_of("thing"), colour("blue"),
                                                 shape("square"), not_from("comsys")}),
                           1)},
  };
}

Members members_of(const BindingCore& core) {
  Members result;
  for (const auto& [id, x] : core.unions()) {
    result.push_back(x.proxy_ids);
    std::sort(result.back().begin(), result.back().end());
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(SystemRun, EndsWithTheUnionsOfThePaper) {
  auto proxies = proxies_of_the_run();
  std::sort(proxies.begin(), proxies.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  do {
    BindingCore core;
    for (const auto& [id, x] : proxies)
      core.set(id, x);
    ASSERT_EQ(members_of(core), (Members{{"P1", "P5"}, {"P2", "P4"}, {"P3"}, {"P4'"}}));
    for (const auto& [id, x] : proxies)
      ASSERT_EQ(core.ambiguity(id), std::nullopt) << id;
  } while (std::next_permutation(proxies.begin(), proxies.end(),
                                 [](const auto& a, const auto& b) { return a.first < b.first; }));
}

TEST(SystemRun, GoesThroughTheStagesOfThePaper) {
  BindingCore core;
  const auto proxies = proxies_of_the_run();
  const std::vector<Members> stages{
    {{"P1"}},
    {{"P1"}, {"P2"}},
    {{"P1"}, {"P2"}, {"P3"}},
    {{"P1"}, {"P2", "P4"}, {"P3"}},
    {{"P1"}, {"P2", "P4"}, {"P3"}, {"P4'"}},
    {{"P1", "P5"}, {"P2", "P4"}, {"P3"}, {"P4'"}},
  };
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const auto change = core.set(proxies[i].first, proxies[i].second);
    EXPECT_EQ(members_of(core), stages[i]);
    // Nobody who was there is bound anew.
    EXPECT_EQ(change.moved, std::vector{proxies[i].first});
    EXPECT_TRUE(change.removed.empty());
  }
  const auto& blue_square = core.unions().at(core.union_of("P1"));
  EXPECT_EQ(blue_square.features.size(), 8u);
  // The tether is still there.
  const auto* tether = find_feature(blue_square.features, FeatureKind::source_data);
  ASSERT_TRUE(tether);
  EXPECT_EQ(tether->data.address, (Address{"vision", "0:1"}));
}

class NothingAround final : public RelationContext {
  const BindingProxy* proxy(const std::string&) const override { return nullptr; }
  std::span<const Port> in_ports(const std::string&) const override { return {}; }
  std::vector<ProxyRef> bound_with(const std::string&) const override { return {}; }
};

TEST(SystemRun, HasTheScoresThatThePaperNeeds) {
  std::map<std::string, BindingProxy> proxies;
  for (auto& [id, x] : proxies_of_the_run())
    proxies.emplace(id, x);
  // Whoever came first in the paper.
  proxies.at("P4").precedence = 1;
  const auto score = [&](const std::string& id, const std::vector<std::string>& members) {
    const auto ref = [&](const std::string& x) {
      const auto found = proxies.find(x);
      return ProxyRef{&found->first, &found->second};
    };
    std::vector<ProxyRef> refs;
    for (const auto& x : members)
      refs.push_back(ref(x));
    return BindingScorer{FeatureComparator{}}.score(ref(id), refs, NothingAround{});
  };
  EXPECT_TRUE(beats(score("P4", {"P2"}), nil_score()));
  EXPECT_TRUE(beats(nil_score(), score("P4", {"P1"})));
  EXPECT_FALSE(score("P4", {"P1"}).comparable);
  EXPECT_TRUE(beats(score("P5", {"P1"}), nil_score()));
  EXPECT_FALSE(score("P5", {"P2"}).comparable);
  EXPECT_FALSE(score("P5", {"P2", "P4"}).comparable);
  EXPECT_FALSE(score("P5", {"P3"}).comparable);
  EXPECT_TRUE(score("P4'", {"P2"}).mismatch);
}

} // namespace

} // namespace castor::binding::test
