#include "castor/actors/component/registry.hpp"
#include "castor/binding/components/binding_component.hpp"
#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/references.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace castor::binding {

namespace {

/// Answers what a description may be about: calls with a ReferenceRequest.
class ReferenceResolver final : public BindingComponent {
  void start() override {
    BindingComponent::start();
    on_call<ReferenceRequest>([this](const ReferenceRequest& x) { return resolve(x); });
  }

  void work(const Changes&) override {}

  ReferenceReply resolve(const ReferenceRequest& request) {
    catch_up();
    auto unions = perceived();
    ReferenceReply reply;
    for (auto& x : request.descriptions) {
      auto all = find_referents(x, unions, comparator_, limit_);
      reply.referents.push_back({distinct_referents(all)});
    }
    for (auto& [id, x] : unions)
      reply.unions.push_back({id, x.proxy_ids.front(), x.features});
    reply.relations = relations_between(unions);
    return reply;
  }

  /// Without what is only said or wished: descriptions do not confirm themselves.
  std::map<std::string, BindingUnion> perceived() const {
    std::map<std::string, BindingUnion> result;
    for (auto& [id, x] : view().unions())
      if (std::ranges::any_of(x->features, [](auto& feature) {
            return feature.kind == FeatureKind::temporal_frame && feature.text == perceived_frame &&
                   !feature.negated;
          }))
        result.emplace(id, *x);
    return result;
  }

  Option<std::uint32_t> limit_{this, "limit", 100000,
                               "how many readings of a description are looked at"};

  FeatureComparator comparator_;
};

CASTOR_COMPONENT(ReferenceResolver, "answers which unions a description may be about")

} // namespace

} // namespace castor::binding
