#pragma once

#include "castor/binding/binding_view.hpp"
#include "castor/binding/features.hpp"
#include "castor/binding/types.hpp"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding::test {

inline Feature concept_of(std::string text) {
  return feature(FeatureKind::concept_name, std::move(text));
}

inline Feature colour(std::string text) {
  return feature(FeatureKind::colour, std::move(text));
}

inline Feature shape(std::string text) {
  return feature(FeatureKind::shape, std::move(text));
}

inline Feature frame(std::string text) {
  return feature(FeatureKind::temporal_frame, std::move(text));
}

inline BindingProxy proxy_from(std::string source, std::vector<Feature> features) {
  BindingProxy result;
  result.source = std::move(source);
  result.features = std::move(features);
  return result;
}

inline BindingProxy relation_from(std::string source, std::string label, std::string from,
                                  std::string to) {
  auto result =
    proxy_from(std::move(source), {feature(FeatureKind::relation_label, std::move(label))});
  result.type = ProxyType::relation;
  result.out_ports = {{"from", std::move(from), {}}, {"to", std::move(to), {}}};
  return result;
}

inline BindingProxy with_precedence(BindingProxy proxy, std::int32_t precedence) {
  proxy.precedence = precedence;
  return proxy;
}

/// Puts a proxy into a view, or another in its place; where it is bound stays as it was.
inline void tell(BindingView& view, const std::string& id, BindingProxy x) {
  for (auto& port : x.out_ports)
    port.owner = id;
  if (const auto* known = view.proxy(id)) {
    x.union_id = known->union_id;
    x.proxy_ids = known->proxy_ids;
  }
  view.set(id, std::make_shared<const BindingProxy>(std::move(x)));
}

/// Binds proxies of a view together.
inline void bind_together(BindingView& view, const std::string& union_id,
                          const std::vector<std::string>& together) {
  BindingUnion in;
  in.proxy_ids = together;
  for (const auto& id : together) {
    auto x = *view.proxy(id);
    x.union_id = union_id;
    x.proxy_ids = together;
    view.set(id, std::make_shared<const BindingProxy>(std::move(x)));
  }
  view.set(union_id, std::make_shared<const BindingUnion>(std::move(in)));
}

/// Who is bound with whom, and as what; without the counters, which tell what happened before.
inline std::map<std::string, BindingUnion>
without_counters(std::map<std::string, BindingUnion> unions) {
  for (auto& [id, x] : unions)
    x.updates = 0;
  return unions;
}

} // namespace castor::binding::test
