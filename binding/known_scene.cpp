#include "castor/binding/known_scene.hpp"

#include "castor/binding/references.hpp"

#include <algorithm>
#include <utility>

namespace castor::binding {

namespace {

bool is_perceived(const BindingUnion& x) {
  return std::ranges::any_of(x.features, [](auto& feature) {
    return feature.kind == FeatureKind::temporal_frame && feature.text == perceived_frame &&
           !feature.negated;
  });
}

} // namespace

KnownScene perceived(const BindingView& view) {
  KnownScene result;
  for (auto& [id, x] : view.unions())
    if (is_perceived(*x))
      result.unions.emplace(id, *x);
  result.relations = relations_between(result.unions);
  return result;
}

void KnownScene::add(const KnowledgeCompetence& from, KnowledgeReply told) {
  std::map<std::string, std::string> union_of;
  for (auto& [id, x] : unions)
    for (auto& proxy : x.proxy_ids)
      union_of.emplace(proxy, id);
  const auto id_of = [&](const std::string& name) {
    const auto bound = union_of.find(name);
    return bound == union_of.end() ? from.subarchitecture + '/' + name : bound->second;
  };
  for (auto& x : told.things) {
    auto& known = unions[id_of(x.proxy.empty() ? x.id : x.proxy)];
    if (known.proxy_ids.empty())
      known.proxy_ids.push_back(from.subarchitecture + '/' + (x.proxy.empty() ? x.id : x.proxy));
    for (auto& feature : x.features)
      if (std::ranges::find(known.features, feature) == known.features.end())
        known.features.push_back(std::move(feature));
  }
  for (auto& x : told.relations)
    relations.push_back({x.label, id_of(x.from), id_of(x.to)});
  std::ranges::sort(relations);
  const auto repeated = std::ranges::unique(relations);
  relations.erase(repeated.begin(), repeated.end());
}

} // namespace castor::binding
