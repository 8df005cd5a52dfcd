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

/// Says which unions are the best for a proxy, once it has been scored against all of them. What it
/// says stands as long as the scores do.
class BindingJudge final : public BindingComponent {
  void start() override {
    BindingComponent::start();
    on_change(changed<ProxyUnionScores>(),
              [this](const ChangeEvent& event) { scored_.insert(event.address.id); });
    for (auto& x : read_all<ProxyUnionScores>())
      scored_.insert(x.address.id);
    // What a predecessor has judged may be gone by now.
    for (auto& x : read_all<BestUnionsForProxy>())
      scored_.insert(std::string{scores_prefix} + x->proxy);
  }

  void work(const Changes& changes) override {
    for (auto& id : changes.unions)
      if (view().unions().contains(id))
        judge_.add_union(id);
      else
        judge_.remove_union(id);
    for (auto& id : std::exchange(scored_, {}))
      try {
        auto scores = read<ProxyUnionScores>(here(id)).object;
        for (auto& x : scores->scores)
          judge_.add(x);
        scores_[scores->proxy] = std::move(scores);
      } catch (const DoesNotExistOnWM&) {
        forget(id.substr(scores_prefix.size()));
      }
    // They may have been judged before they were seen.
    for (auto& id : changes.proxies)
      if (auto judgement = judge_.judgement(id))
        tell(id, *judgement);
    for (auto& [proxy, judgement] : judge_.take_new())
      tell(proxy, judgement);
  }

  void tell(const std::string& id, const Judgement& judgement) {
    put(best_id(id), judgement.best);
    put(non_matching_id(id), judgement.non_matching);
    std::vector<const BindingUnion*> unions;
    for (auto& x : judgement.best.unions)
      if (auto found = view().unions().find(x); found != view().unions().end())
        unions.push_back(found->second.get());
    auto* proxy = view().proxy(id);
    if (proxy && is_ambiguous(judgement.best, scores_.at(id)->scores))
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

  static std::string best_id(const std::string& proxy) { return std::string{best_prefix} + proxy; }
  static std::string non_matching_id(const std::string& proxy) {
    return "non-matching unions for " + proxy;
  }
  static std::string ambiguity_id(const std::string& proxy) { return "ambiguity of " + proxy; }

  binding::BindingJudge judge_;
  /// Knows which kinds of features say something about each other.
  FeatureComparator comparator_;
  /// Entries with new scores.
  std::set<std::string> scored_;
  std::map<std::string, std::shared_ptr<const ProxyUnionScores>> scores_;
};

CASTOR_COMPONENT(BindingJudge, "decides which unions are best for a binding proxy")

} // namespace

} // namespace castor::binding::components
