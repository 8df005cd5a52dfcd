#include "castor/binding/binding_judge.hpp"

#include "castor/actors/registry.hpp"
#include "castor/binding/components/binding_component.hpp"
#include "castor/binding/feature_comparator.hpp"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding::components {

namespace {

/// Says which unions are the best for a proxy, once it has been scored against all of them.
class BindingJudge final : public BindingComponent {
  void start() override {
    BindingComponent::start();
    on_change(changed<ProxyUnionScores>(),
              [this](const ChangeEvent& event) { scored_.insert(event.address.id); });
    for (auto& x : read_all<ProxyUnionScores>())
      scored_.insert(x.address.id);
    for (auto& x : read_all<BestUnionsForProxy>())
      judged_before_.insert(x->proxy);
  }

  void work(const Changes& changes) override {
    for (auto& id : changes.unions)
      if (view().unions().contains(id))
        judge_.add_union(id);
      else
        judge_.remove_union(id);
    for (auto& id : changes.proxies)
      if (!view().proxy(id))
        forget(id);
    for (auto& id : std::exchange(judged_before_, {}))
      if (!view().proxy(id))
        forget(id);
    for (auto& id : std::exchange(scored_, {}))
      try {
        auto scores = read<ProxyUnionScores>(here(id)).object;
        for (auto& x : scores->scores)
          judge_.add(x);
        scores_[scores->proxy] = std::move(scores);
      } catch (const DoesNotExistOnWM&) {
        trace("{} is gone", id);
      }
    for (auto& [proxy, judgement] : judge_.take_new())
      tell(proxy, judgement);
  }

  void tell(const std::string& id, const Judgement& judgement) {
    auto* proxy = view().proxy(id);
    if (!proxy)
      return forget(id);
    put(best_id(id), judgement.best);
    put(non_matching_id(id), judgement.non_matching);
    std::vector<const BindingUnion*> unions;
    for (auto& x : judgement.best.unions)
      if (auto found = view().unions().find(x); found != view().unions().end())
        unions.push_back(found->second.get());
    if (is_ambiguous(judgement.best, scores_.at(id)->scores))
      put(ambiguity_id(id), describe_ambiguity(judgement.best, *proxy, unions, comparator_));
    else
      drop(ambiguity_id(id));
  }

  void forget(const std::string& id) {
    judge_.forget(id);
    scores_.erase(id);
    for (auto& x : {best_id(id), non_matching_id(id), ambiguity_id(id)})
      drop(x);
  }

  static std::string best_id(const std::string& proxy) { return "best unions for " + proxy; }
  static std::string non_matching_id(const std::string& proxy) {
    return "non-matching unions for " + proxy;
  }
  static std::string ambiguity_id(const std::string& proxy) { return "ambiguity of " + proxy; }

  binding::BindingJudge judge_;
  /// Knows which kinds of features say something about each other.
  FeatureComparator comparator_;
  /// Proxies that a predecessor has judged.
  std::set<std::string> judged_before_;
  /// Entries with new scores.
  std::set<std::string> scored_;
  std::map<std::string, std::shared_ptr<const ProxyUnionScores>> scores_;
};

CASTOR_COMPONENT(BindingJudge, "decides which unions are best for a binding proxy")

} // namespace

} // namespace castor::binding::components
