// A scorer, a judge and a binder that work in parallel, each at its own pace, on proxies that come,
// change and go meanwhile: whatever the interleaving, they end up with the unions of BindingCore.
#include "castor/binding/binder.hpp"
#include "castor/binding/binding_core.hpp"
#include "castor/binding/binding_judge.hpp"
#include "castor/binding/binding_score.hpp"
#include "castor/tests/binding/chance.hpp"
#include "castor/tests/binding/proxies.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding::test {

namespace {

/// The working memory, and the three around it. Each step is one entry that one of them sees to.
class Components final : private Surroundings {
public:
  void set(const std::string& id, BindingProxy x) {
    remove(id);
    for (auto& port : x.out_ports)
      port.owner = id;
    proxies_[id] = std::move(x);
    rescore_all();
  }

  void remove(const std::string& id) {
    if (!proxies_.contains(id))
      return;
    leave(id);
    proxies_.erase(id);
    to_score_.erase(id);
    best_.erase(id);
    judge_.forget(id);
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
    for (const auto& [id, members] : members_)
      result.emplace(id, make_union(refs(members), *this));
    return result;
  }

private:
  bool score(Chance& chance) {
    if (to_score_.empty())
      return false;
    const auto id = *std::next(to_score_.begin(), chance.below(static_cast<int>(to_score_.size())));
    to_score_.erase(id);
    const FeatureComparator comparator;
    for (const auto& [union_id, members] : members_)
      scored_.push_back(
        {id, union_id, BindingScorer{comparator}.score(ref(id), refs(members), *this)});
    scored_.push_back({id, "", nil_score()});
    return true;
  }

  bool judge() {
    if (scored_.empty())
      return false;
    // One score at a time: what it has may be old or incomplete.
    const auto score = scored_.front();
    scored_.erase(scored_.begin());
    if (score.union_id.empty() || members_.contains(score.union_id))
      judge_.add(score);
    for (auto& [id, judgement] : judge_.take_new())
      best_[id] = judgement.best.unions.empty() ? std::string{} : judgement.best.unions.front();
    return true;
  }

  bool bind(Chance& chance) {
    std::vector<std::string> able;
    for (const auto& [id, best] : best_) {
      const auto& wanted = best.empty() ? union_id_of(id) : best;
      if (union_of_[id] != wanted && (best.empty() || members_.contains(best)))
        able.push_back(id);
    }
    if (able.empty())
      return false;
    const auto id = able[static_cast<std::size_t>(chance.below(static_cast<int>(able.size())))];
    const auto current_id = union_of_[id];
    const auto current =
      current_id.empty() ? BindingUnion{} : make_union(refs(members_.at(current_id)), *this);
    const auto step =
      next_step(ref(id), current_id, current_id.empty() ? nullptr : &current, best_.at(id));
    EXPECT_NE(step.kind, BinderStep::Kind::renew);
    EXPECT_EQ(step.delete_from, !step.from.empty() && members_.at(step.from).size() == 1);
    leave(id);
    if (!members_.contains(step.to))
      judge_.add_union(step.to);
    members_[step.to].insert(id);
    union_of_[id] = step.to;
    rescore_all();
    return true;
  }

  void leave(const std::string& id) {
    const auto left = std::exchange(union_of_[id], {});
    const auto found = members_.find(left);
    if (found == members_.end())
      return;
    found->second.erase(id);
    if (found->second.empty()) {
      members_.erase(found);
      judge_.remove_union(left);
    }
  }

  void rescore_all() {
    for (const auto& [id, x] : proxies_)
      to_score_.insert(id);
    ports_.clear();
    for (const auto& [id, x] : proxies_) {
      for (const auto& port : x.out_ports)
        ports_[port.proxy].push_back(port);
    }
  }

  ProxyRef ref(const std::string& id) const {
    const auto found = proxies_.find(id);
    return {&found->first, &found->second};
  }

  std::vector<ProxyRef> refs(const std::set<std::string>& ids) const {
    std::vector<ProxyRef> result;
    for (const auto& id : ids)
      result.push_back(ref(id));
    return result;
  }

  const BindingProxy* proxy(const std::string& id) const override {
    const auto found = proxies_.find(id);
    return found == proxies_.end() ? nullptr : &found->second;
  }

  std::span<const Port> in_ports(const std::string& id) const override {
    const auto found = ports_.find(id);
    return found == ports_.end() ? std::span<const Port>{} : found->second;
  }

  std::vector<ProxyRef> bound_with(const std::string& id) const override {
    const auto found = union_of_.find(id);
    if (found == union_of_.end() || found->second.empty())
      return {ref(id)};
    return refs(members_.at(found->second));
  }

  Proxies proxies_;
  std::map<std::string, std::vector<Port>> ports_;
  std::map<std::string, std::set<std::string>> members_;
  std::map<std::string, std::string> union_of_;
  std::set<std::string> to_score_;
  std::vector<ProxyUnionScore> scored_;
  BindingJudge judge_;
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
