#pragma once

#include "castor/binding/binding_scorer.hpp"
#include "castor/binding/types.hpp"

#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace castor::binding {

/// The proxies and unions of the binding working memory, as a component has seen them last. Both
/// come and go one by one, so a union may name members that are not known yet, or are gone.
class BindingView final : public RelationContext {
public:
  void set(const std::string& id, std::shared_ptr<const BindingProxy> proxy);
  void set(const std::string& id, std::shared_ptr<const BindingUnion> in);
  void remove_proxy(const std::string& id);
  void remove_union(const std::string& id);

  const std::map<std::string, std::shared_ptr<const BindingProxy>>& proxies() const {
    return proxies_;
  }
  const std::map<std::string, std::shared_ptr<const BindingUnion>>& unions() const {
    return unions_;
  }

  /// \pre there is such a proxy.
  ProxyRef ref(const std::string& id) const;

  /// Those of these proxies that are known.
  std::vector<ProxyRef> refs(std::span<const std::string> ids) const;

  /// What is asked of the surroundings of others makes a difference to this proxy: it is a relation
  /// or has some.
  bool has_ports(const std::string& id) const;

  const BindingProxy* proxy(const std::string& id) const override;
  std::span<const Port> in_ports(const std::string& id) const override;
  std::vector<ProxyRef> bound_with(const std::string& id) const override;

private:
  void unlink(const BindingProxy& proxy, const std::string& id);

  std::map<std::string, std::shared_ptr<const BindingProxy>> proxies_;
  std::map<std::string, std::shared_ptr<const BindingUnion>> unions_;
  /// By the proxy that they lead to; ordered by the relation, whatever came first.
  std::map<std::string, std::vector<Port>> in_ports_;
};

} // namespace castor::binding
