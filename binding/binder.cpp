#include "castor/binding/binder.hpp"

#include "castor/binding/binding_order.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace castor::binding {

namespace {

void put_in_order(std::vector<ProxyRef>& members) {
  std::sort(members.begin(), members.end(),
            [](const ProxyRef& a, const ProxyRef& b) { return precedes(a, b); });
}

/// Reads a list part by part.
template <class T>
class Parts {
public:
  explicit Parts(const std::vector<T>& all) : all_(all) {}

  bool next_is(std::span<const T> part) {
    const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(read_);
    if (all_.size() - read_ < part.size() || !std::equal(part.begin(), part.end(), begin))
      return false;
    read_ += part.size();
    return true;
  }

  bool is_read() const { return read_ == all_.size(); }

private:
  const std::vector<T>& all_;
  std::size_t read_ = 0;
};

/// Whether the union is what `make_union` would make, and its members know of it. Most are, so this
/// is found out without making one.
bool is_up_to_date(std::span<const ProxyRef> ordered, const std::string& id,
                   const BindingUnion& known, const RelationContext& context) {
  if (known.proxy_ids.size() != ordered.size() || known.type != ordered.front().proxy->type)
    return false;
  Parts features{known.features};
  Parts out_ports{known.out_ports};
  Parts in_ports{known.in_ports};
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    const auto& proxy = *ordered[i].proxy;
    if (*ordered[i].id != known.proxy_ids[i] || proxy.source != known.sources[i] ||
        proxy.union_id != id || proxy.proxy_ids != known.proxy_ids ||
        !features.next_is(proxy.features) || !out_ports.next_is(proxy.out_ports) ||
        !in_ports.next_is(context.in_ports(*ordered[i].id)))
      return false;
  }
  return features.is_read() && out_ports.is_read() && in_ports.is_read();
}

} // namespace

BindingUnion make_union(std::span<const ProxyRef> members, const RelationContext& context) {
  std::vector<ProxyRef> ordered(members.begin(), members.end());
  put_in_order(ordered);
  BindingUnion result;
  result.type = ordered.front().proxy->type;
  for (const auto& member : ordered) {
    const auto& proxy = *member.proxy;
    const auto in_ports = context.in_ports(*member.id);
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

namespace {

/// Where the proxy is to be; empty if that is not known yet.
std::string place_of(const std::string& id, const BindingProxy& proxy, const BindingView& view,
                     const std::map<std::string, std::string>& best) {
  auto judged = best.find(id);
  auto current = view.unions().contains(proxy.union_id) ? proxy.union_id : std::string{};
  if (judged == best.end())
    return current;
  if (judged->second.empty())
    return union_id_of(id);
  return view.unions().contains(judged->second) ? judged->second : current;
}

/// But for how often it has changed.
bool same_content(BindingUnion a, const BindingUnion& b) {
  a.updates = b.updates;
  return a == b;
}

} // namespace

BindingPlan plan_binding(const BindingView& view, const std::map<std::string, std::string>& best,
                         const std::set<std::string>& leaving) {
  std::map<std::string, std::vector<ProxyRef>> members;
  for (auto& [id, proxy] : view.proxies())
    if (auto place = place_of(id, *proxy, view, best); !place.empty() && !leaving.contains(id))
      members[place].push_back(view.ref(id));
  BindingPlan result;
  for (auto& [id, refs] : members) {
    put_in_order(refs);
    auto known = view.unions().find(id);
    if (known != view.unions().end() && is_up_to_date(refs, id, *known->second, view))
      continue;
    auto wanted = make_union(refs, view);
    if (known != view.unions().end())
      wanted.updates = known->second->updates + 1;
    for (auto& x : refs)
      if (x.proxy->union_id != id || x.proxy->proxy_ids != wanted.proxy_ids)
        result.proxies[*x.id] = bound(*x.proxy, id, wanted);
    if (known == view.unions().end() || !same_content(wanted, *known->second))
      result.unions[id] = std::move(wanted);
  }
  for (auto& [id, x] : view.unions())
    if (!members.contains(id))
      result.deleted_unions.insert(id);
  return result;
}

} // namespace castor::binding
