#include "castor/binding/binder.hpp"

#include <algorithm>
#include <vector>

namespace castor::binding {

BinderStep next_step(const ProxyRef& proxy, const std::string& current_id,
                     const BindingUnion* current, const std::string& best) {
  BinderStep step;
  const bool alone = current && current->proxy_ids.size() == 1;
  step.to = best.empty() ? union_id_of(*proxy.id) : best;
  if (current && current_id == step.to) {
    step.kind = BinderStep::Kind::renew;
    step.from = current_id;
  } else if (current) {
    step.kind = BinderStep::Kind::move;
    step.from = current_id;
    step.delete_from = alone;
  } else {
    step.kind = best.empty() ? BinderStep::Kind::create : BinderStep::Kind::join;
  }
  return step;
}

BindingUnion make_union(std::span<const ProxyRef> members, const Surroundings& surroundings) {
  std::vector<ProxyRef> ordered(members.begin(), members.end());
  std::sort(ordered.begin(), ordered.end(), [](const ProxyRef& a, const ProxyRef& b) {
    return rank_of(*a.id, *a.proxy) < rank_of(*b.id, *b.proxy);
  });
  BindingUnion result;
  result.type = ordered.front().proxy->type;
  for (const auto& member : ordered) {
    const auto& proxy = *member.proxy;
    const auto in_ports = surroundings.in_ports(*member.id);
    result.proxy_ids.push_back(*member.id);
    result.sources.push_back(proxy.source);
    result.features.insert(result.features.end(), proxy.features.begin(), proxy.features.end());
    result.out_ports.insert(result.out_ports.end(), proxy.out_ports.begin(), proxy.out_ports.end());
    result.in_ports.insert(result.in_ports.end(), in_ports.begin(), in_ports.end());
  }
  return result;
}

BindingProxy bound(BindingProxy proxy, const std::string& union_id, const BindingUnion& in) {
  proxy.union_id = union_id;
  proxy.proxy_ids = in.proxy_ids;
  proxy.state = ProxyState::bound;
  ++proxy.binding_count;
  return proxy;
}

} // namespace castor::binding
