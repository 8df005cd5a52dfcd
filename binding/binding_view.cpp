#include "castor/binding/binding_view.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace castor::binding {

void BindingView::set(const std::string& id, std::shared_ptr<const BindingProxy> proxy) {
  remove_proxy(id);
  for (auto& port : proxy->out_ports) {
    auto& ports = in_ports_[port.proxy];
    ports.insert(std::ranges::upper_bound(ports, std::tie(port.owner, port.label), {},
                                          [](const Port& x) { return std::tie(x.owner, x.label); }),
                 port);
  }
  proxies_[id] = std::move(proxy);
}

void BindingView::set(const std::string& id, std::shared_ptr<const BindingUnion> in) {
  unions_[id] = std::move(in);
}

void BindingView::remove_proxy(const std::string& id) {
  auto found = proxies_.find(id);
  if (found == proxies_.end())
    return;
  unlink(*found->second, id);
  proxies_.erase(found);
}

void BindingView::unlink(const BindingProxy& proxy, const std::string& id) {
  for (auto& port : proxy.out_ports) {
    auto found = in_ports_.find(port.proxy);
    if (found == in_ports_.end())
      continue;
    std::erase_if(found->second, [&](const Port& x) { return x.owner == id; });
    if (found->second.empty())
      in_ports_.erase(found);
  }
}

void BindingView::remove_union(const std::string& id) {
  unions_.erase(id);
}

ProxyRef BindingView::ref(const std::string& id) const {
  auto found = proxies_.find(id);
  return {&found->first, found->second.get()};
}

std::vector<ProxyRef> BindingView::refs(std::span<const std::string> ids) const {
  std::vector<ProxyRef> result;
  result.reserve(ids.size());
  for (auto& id : ids)
    if (proxies_.contains(id))
      result.push_back(ref(id));
  return result;
}

bool BindingView::has_ports(const std::string& id) const {
  auto* known = proxy(id);
  return (known && known->type == ProxyType::relation) || in_ports_.contains(id);
}

const BindingProxy* BindingView::proxy(const std::string& id) const {
  auto found = proxies_.find(id);
  return found == proxies_.end() ? nullptr : found->second.get();
}

std::span<const Port> BindingView::in_ports(const std::string& id) const {
  auto found = in_ports_.find(id);
  return found == in_ports_.end() ? std::span<const Port>{} : found->second;
}

std::vector<ProxyRef> BindingView::bound_with(const std::string& id) const {
  auto* known = proxy(id);
  if (!known)
    return {};
  auto in = unions_.find(known->union_id);
  return in == unions_.end() ? std::vector{ref(id)} : refs(in->second->proxy_ids);
}

} // namespace castor::binding
