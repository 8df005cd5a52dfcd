// What holds for whatever proxies come and go, against binding from scratch, one after the other.
#include "castor/binding/binder.hpp"
#include "castor/binding/binding_judge.hpp"
#include "castor/tests/binding/chance.hpp"
#include "castor/tests/binding/proxies.hpp"
#include "castor/tests/binding/reference/binding_core.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding::test {

namespace {

constexpr int runs = 150;

/// From scratch, in binding order, by the scorer and the judge alone.
class Naive {
public:
  Naive(const Proxies& proxies, const FeatureComparator& comparator) {
    BindingView view;
    std::vector<std::string> order;
    for (const auto& [id, x] : proxies) {
      tell(view, id, x);
      order.push_back(id);
    }
    std::sort(order.begin(), order.end(), [&proxies](const auto& a, const auto& b) {
      return rank_of(a, proxies.at(a)) < rank_of(b, proxies.at(b));
    });
    const BindingScorer scorer(comparator);
    std::map<std::string, std::vector<std::string>> all_members;
    for (const auto& id : order) {
      std::vector<ProxyUnionScore> scores;
      for (const auto& [union_id, members] : all_members)
        scores.push_back({id, union_id, scorer.score(view.ref(id), view.refs(members), view)});
      const auto best = judge(id, scores).unions;
      best_unions[id] = best;
      const auto union_id = best.empty() ? union_id_of(id) : best.front();
      auto& members = all_members[union_id];
      members.push_back(id);
      bind_together(view, union_id, members);
    }
    for (const auto& [union_id, members] : all_members)
      unions.emplace(union_id, make_union(view.refs(members), view));
  }

  std::map<std::string, BindingUnion> unions;
  std::map<std::string, std::vector<std::string>> best_unions;
};

void expect_as_from_scratch(const BindingCore& core, const Proxies& proxies) {
  const Naive naive(proxies, core.comparator());
  ASSERT_EQ(without_counters(core.unions()), naive.unions);
  for (const auto& [id, best] : naive.best_unions)
    ASSERT_EQ(core.best_unions(id).unions, best) << id;
}

TEST(BindingProperties, TheOrderOfArrivalDoesNotMatter) {
  for (int seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    const auto proxies = chance.some_proxies(2 + chance.below(25));
    std::vector<std::string> ids;
    for (const auto& [id, x] : proxies)
      ids.push_back(id);
    for (int order = 0; order < 4; ++order) {
      BindingCore core;
      chance.shuffle(ids);
      for (const auto& id : ids)
        core.set(id, proxies.at(id));
      expect_as_from_scratch(core, proxies);
      ASSERT_FALSE(::testing::Test::HasFatalFailure());
    }
  }
}

TEST(BindingProperties, ChangesAndDeletionsLeaveNoTrace) {
  for (int seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    BindingCore core;
    Proxies proxies;
    for (int step = 0; step < 60; ++step) {
      const auto id = Chance::id(chance.below(14));
      if (chance.once_in(3)) {
        core.remove(id);
        proxies.erase(id);
      } else {
        proxies[id] = chance.some_proxy(14);
        core.set(id, proxies[id]);
      }
      expect_as_from_scratch(core, proxies);
      ASSERT_FALSE(::testing::Test::HasFatalFailure()) << "step " << step;
    }
    while (!proxies.empty()) {
      core.remove(proxies.begin()->first);
      proxies.erase(proxies.begin());
    }
    EXPECT_TRUE(core.unions().empty());
    EXPECT_EQ(core.size(), 0u);
  }
}

TEST(BindingProperties, DeletingWhatWasAddedRestoresWhatWas) {
  for (int seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    BindingCore core;
    for (const auto& [id, x] : chance.some_proxies(20))
      core.set(id, x);
    const auto before = without_counters(core.unions());
    // Before, between and after the others in binding order.
    for (const auto* id : {"a", "p10x", "z"}) {
      core.set(id, chance.some_proxy(20));
      core.remove(id);
      ASSERT_EQ(without_counters(core.unions()), before);
    }
  }
}

TEST(BindingProperties, AnswersOfOthersMayComeWhenTheyWill) {
  for (int seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    const auto proxies = chance.some_proxies(18);
    FeatureComparisonCompetence coma;
    coma.subarchitecture = "coma";
    coma.trust_yes = chance.once_in(2) ? Trust::not_at_all : Trust::completely;
    const auto answer = chance.once_in(2) ? Truth::yes : Truth::no;
    BindingCore early;
    early.add(coma);
    early.answer(concept_of("ball"), concept_of("toy"), answer);
    BindingCore late;
    for (const auto& [id, x] : proxies) {
      early.set(id, x);
      late.set(id, x);
    }
    late.add(coma);
    late.answer(concept_of("toy"), concept_of("ball"), answer);
    expect_as_from_scratch(early, proxies);
    ASSERT_EQ(without_counters(late.unions()), without_counters(early.unions()));
    late.remove_competences("coma");
    expect_as_from_scratch(late, proxies);
    ASSERT_FALSE(::testing::Test::HasFatalFailure());
  }
}

TEST(BindingProperties, UnionsAreAPartitionOfProxiesThatDoNotExcludeEachOther) {
  int shared = 0;
  for (int seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    const auto proxies = chance.some_proxies(25);
    BindingCore core;
    for (const auto& [id, x] : proxies)
      core.set(id, x);
    std::set<std::string> seen;
    for (const auto& [union_id, x] : core.unions()) {
      ASSERT_FALSE(x.proxy_ids.empty());
      std::vector<Feature> features;
      for (const auto& id : x.proxy_ids) {
        ASSERT_TRUE(seen.insert(id).second) << id;
        EXPECT_EQ(core.union_of(id), union_id);
        const auto& own = proxies.at(id).features;
        features.insert(features.end(), own.begin(), own.end());
      }
      EXPECT_TRUE(std::is_permutation(features.begin(), features.end(), x.features.begin(),
                                      x.features.end()));
      for (const auto& a : x.proxy_ids) {
        for (const auto& b : x.proxy_ids) {
          if (a == b)
            continue;
          ++shared;
          EXPECT_EQ(proxies.at(a).type, proxies.at(b).type);
          for (const auto& one : proxies.at(a).features) {
            if (one.kind == FeatureKind::other_source_id) {
              EXPECT_NE(one.text, proxies.at(b).source);
            }
            for (const auto& other : proxies.at(b).features)
              EXPECT_NE(compare(one, other), Truth::no)
                << to_string(one) << " of " << a << ", " << to_string(other) << " of " << b;
          }
        }
      }
    }
    EXPECT_EQ(seen.size(), proxies.size());
  }
  EXPECT_GT(shared, runs);
}

TEST(BindingProperties, WhatIsUnknownNeitherBindsNorUnbinds) {
  for (int seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    auto proxies = chance.some_proxies(20);
    // Where something has become comparable, relations may count that did not before.
    std::erase_if(proxies, [](const auto& x) { return !x.second.out_ports.empty(); });
    BindingCore core;
    for (const auto& [id, x] : proxies)
      core.set(id, x);
    const auto members_of = [&core] {
      std::map<std::string, std::string> result;
      for (int i = 0; i < 20; ++i)
        result[Chance::id(i)] = core.union_of(Chance::id(i));
      return result;
    };
    const auto before = members_of();
    for (auto& [id, x] : proxies) {
      x.features.push_back(feature(FeatureKind::material, "unknown"));
      x.features.push_back(feature(FeatureKind::debug_string, id));
      core.set(id, x);
    }
    EXPECT_EQ(members_of(), before);
  }
}

TEST(BindingProperties, ChangesAreReported) {
  for (int seed = 0; seed < runs; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    BindingCore core;
    std::map<std::string, BindingUnion> known;
    std::map<std::string, std::string> where;
    for (int step = 0; step < 40; ++step) {
      const auto id = Chance::id(chance.below(12));
      const auto change = chance.once_in(3) ? core.remove(id) : core.set(id, chance.some_proxy(12));
      for (const auto& x : change.removed)
        ASSERT_EQ(known.erase(x), 1u) << x;
      for (const auto& x : change.changed)
        known[x] = core.unions().at(x);
      ASSERT_EQ(known, core.unions());
      for (const auto& x : change.moved) {
        ASSERT_NE(where[x], core.union_of(x));
        where[x] = core.union_of(x);
      }
      for (int i = 0; i < 12; ++i) {
        if (core.union_of(Chance::id(i)).empty())
          where.erase(Chance::id(i));
        else
          ASSERT_EQ(where[Chance::id(i)], core.union_of(Chance::id(i)));
      }
    }
  }
}

} // namespace

} // namespace castor::binding::test
