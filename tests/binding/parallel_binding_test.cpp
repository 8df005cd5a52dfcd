// A scorer, a judge and a binder that work in parallel, each at its own pace, on proxies that come,
// change and go meanwhile: whatever the interleaving, they end up with the unions of BindingCore.
#include "castor/binding/binder.hpp"
#include "castor/binding/binding_judge.hpp"
#include "castor/binding/binding_score.hpp"
#include "castor/binding/binding_view.hpp"
#include "castor/tests/binding/chance.hpp"
#include "castor/tests/binding/proxies.hpp"
#include "castor/tests/binding/reference/binding_core.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding::test {

namespace {

/// The working memory, and the three around it. Each step is one entry that one of them sees to.
class Components {
public:
  void set(const std::string& id, BindingProxy x) {
    tell(view_, id, std::move(x));
    rescore_all();
  }

  void remove(const std::string& id) {
    if (!view_.proxy(id))
      return;
    carry_out(plan_binding(view_, {}, {id}));
    view_.remove_proxy(id);
    to_score_.erase(id);
    best_.erase(id);
    std::erase_if(scored_, [&](const auto& x) { return x.proxy == id; });
    rescore_all();
  }

  /// Whether there was anything to do.
  bool step(Chance& chance) {
    for (int attempt = chance.below(3), tried = 0; tried < 3;
         ++tried, attempt = (attempt + 1) % 3) {
      if (attempt == 0 ? score(chance) : attempt == 1 ? judge() : bind(chance))
        return true;
    }
    return false;
  }

  std::map<std::string, BindingUnion> unions() const {
    std::map<std::string, BindingUnion> result;
    for (const auto& [id, x] : view_.unions())
      result.emplace(id, *x);
    return without_counters(std::move(result));
  }

private:
  bool score(Chance& chance) {
    if (to_score_.empty())
      return false;
    const auto id = *std::next(to_score_.begin(), chance.below(static_cast<int>(to_score_.size())));
    to_score_.erase(id);
    const FeatureComparator comparator;
    ProxyUnionScores scores{id, {{id, "", nil_score()}}};
    for (const auto& [union_id, x] : view_.unions())
      scores.scores.push_back(
        {id, union_id,
         BindingScorer{comparator}.score(view_.ref(id), view_.refs(x->proxy_ids), view_)});
    scored_.push_back(std::move(scores));
    return true;
  }

  bool judge() {
    if (scored_.empty())
      return false;
    // One proxy at a time: its scores may be old by now.
    const auto scores = scored_.front();
    scored_.erase(scored_.begin());
    const auto best = binding::judge(scores.proxy, scores.scores);
    best_[scores.proxy] = best.unions.empty() ? std::string{} : best.unions.front();
    return true;
  }

  /// Some of what is known to be better, but not all of it.
  bool bind(Chance& chance) {
    std::map<std::string, std::string> some;
    for (const auto& x : best_)
      if (!chance.once_in(3))
        some.insert(x);
    auto plan = plan_binding(view_, some);
    if (plan.empty())
      plan = plan_binding(view_, best_);
    if (plan.empty())
      return false;
    carry_out(plan);
    rescore_all();
    return true;
  }

  void carry_out(const BindingPlan& plan) {
    for (const auto& [id, x] : plan.unions)
      view_.set(id, std::make_shared<const BindingUnion>(x));
    for (const auto& id : plan.deleted_unions)
      view_.remove_union(id);
    for (const auto& [id, x] : plan.proxies)
      view_.set(id, std::make_shared<const BindingProxy>(x));
  }

  void rescore_all() {
    for (const auto& [id, x] : view_.proxies())
      to_score_.insert(id);
  }

  BindingView view_;
  std::set<std::string> to_score_;
  std::vector<ProxyUnionScores> scored_;
  std::map<std::string, std::string> best_;
};

TEST(ParallelBinding, EndsWithTheSameUnionsWhateverTheInterleaving) {
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    Components components;
    BindingCore core;
    for (int change = 0; change < 25; ++change) {
      const auto id = Chance::id(chance.below(10));
      if (chance.once_in(4)) {
        components.remove(id);
        core.remove(id);
      } else {
        const auto x = chance.some_proxy(10);
        components.set(id, x);
        core.set(id, x);
      }
      for (int steps = chance.below(150); steps > 0; --steps)
        components.step(chance);
    }
    int steps = 0;
    while (components.step(chance))
      ASSERT_LT(++steps, 100'000);
    ASSERT_EQ(components.unions(), without_counters(core.unions()));
  }
}

} // namespace

} // namespace castor::binding::test
