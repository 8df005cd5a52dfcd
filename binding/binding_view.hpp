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

/// The proxies and unions of the binding working memory, as last seen by a component. They change
/// one by one, so a union may name members that are not known yet, or were deleted.
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

  /// The known ones of these proxies.
  std::vector<ProxyRef> refs(std::span<const std::string> ids) const;

  /// Whether the proxy is a relation or an end of one, so that its score depends on other proxies'
  /// unions.
  bool has_ports(const std::string& id) const;

  const BindingProxy* proxy(const std::string& id) const override;
  std::span<const Port> in_ports(const std::string& id) const override;
  std::vector<ProxyRef> bound_with(const std::string& id) const override;

private:
  void unlink(const BindingProxy& proxy, const std::string& id);

  std::map<std::string, std::shared_ptr<const BindingProxy>> proxies_;
  std::map<std::string, std::shared_ptr<const BindingUnion>> unions_;
  /// By the proxy that they lead to; ordered by the relation's id, independent of the order of
  /// arrival.
  std::map<std::string, std::vector<Port>> in_ports_;
};

} // namespace castor::binding
