#include "castor/binding/binding_judge.hpp"

#include "castor/actors/component/registry.hpp"
#include "castor/binding/components/binding_component.hpp"
#include "castor/binding/feature_comparator.hpp"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding::components {

namespace {

/// Says which unions are the best for a proxy, once it has been scored. What it says stands as long
/// as the scores do.
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
    // They may have been scored before they were seen.
    for (auto& id : changes.proxies)
      scored_.insert(std::string{scores_prefix} + id);
    for (auto& id : std::exchange(scored_, {}))
      try {
        auto scores = read<ProxyUnionScores>(here(id));
        tell(judge(scores->proxy, scores->scores), scores->scores);
      } catch (const DoesNotExistOnWM&) {
        forget(id.substr(scores_prefix.size()));
      }
  }

  void tell(const BestUnionsForProxy& best, const std::vector<ProxyUnionScore>& scores) {
    put(best_id(best.proxy), best);
    std::vector<const BindingUnion*> unions;
    for (auto& x : best.unions)
      if (auto found = view().unions().find(x); found != view().unions().end())
        unions.push_back(found->second.get());
    auto* proxy = view().proxy(best.proxy);
    if (proxy && is_ambiguous(best, scores))
      put(ambiguity_id(best.proxy), describe_ambiguity(best, *proxy, unions, comparator_));
    else
      drop(ambiguity_id(best.proxy));
  }

  void forget(const std::string& proxy) {
    drop(best_id(proxy));
    drop(ambiguity_id(proxy));
  }

  static std::string best_id(const std::string& proxy) { return std::string{best_prefix} + proxy; }
  static std::string ambiguity_id(const std::string& proxy) { return "ambiguity of " + proxy; }

  /// Knows which kinds of features say something about each other.
  FeatureComparator comparator_;
  /// Entries with new scores.
  std::set<std::string> scored_;
};

CASTOR_COMPONENT(BindingJudge, "decides which unions are best for a binding proxy")

} // namespace

} // namespace castor::binding::components
