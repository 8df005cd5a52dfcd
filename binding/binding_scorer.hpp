#pragma once

#include "castor/binding/binding_order.hpp"
#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/types.hpp"

#include <span>
#include <string>
#include <vector>

namespace castor::binding {

/// A proxy and its id. Does not own them.
struct ProxyRef {
  const std::string* id = nullptr;
  const BindingProxy* proxy = nullptr;
};

/// Whether `a` is bound before `b`.
inline bool precedes(const ProxyRef& a, const ProxyRef& b) {
  return precedes(*a.id, *a.proxy, *b.id, *b.proxy);
}

/// The relations that the scorer needs besides the proxy and the union to be scored.
class RelationContext {
public:
  virtual ~RelationContext() = default;

  /// The proxy of that id; nullptr if it is not (or not yet) there.
  virtual const BindingProxy* proxy(const std::string& id) const = 0;

  /// The ports of relations that lead to a proxy.
  virtual std::span<const Port> in_ports(const std::string& id) const = 0;

  /// The proxies in the same union, itself included.
  virtual std::vector<ProxyRef> bound_with(const std::string& id) const = 0;
};

/// Scores proxies against unions, by section 5.2 of the original's rules (docs/binding.md).
class BindingScorer {
public:
  explicit BindingScorer(const FeatureComparator& comparator) : comparator_(comparator) {}

  /// Score of a proxy with the members of a union.
  ///
  /// \param members in any order. Those not before the proxy in binding order are ignored; if none
  ///        is left, the union is not comparable.
  BindingScore score(const ProxyRef& proxy, std::span<const ProxyRef> members,
                     const RelationContext& context) const;

  /// The part of the score that depends on features and types.
  BindingScore feature_score(const ProxyRef& proxy, std::span<const ProxyRef> members) const;

  /// Comparisons to request from other subarchitectures before the score is certain.
  std::vector<FeatureComparison> open_comparisons(const BindingProxy& proxy,
                                                  const BindingProxy& member) const;

private:
  void add_features(const BindingProxy& proxy, const BindingProxy& member, KindSet& matched,
                    BindingScore& score) const;
  void add_relations(const ProxyRef& proxy, std::span<const ProxyRef> members,
                     const RelationContext& context, BindingScore& score) const;
  Truth relation_between(const ProxyRef& proxy, const Port& own, const Port& other,
                         const RelationContext& context) const;
  Truth same_thing(const ProxyRef& judged, const std::string& a, const std::string& b,
                   const RelationContext& context) const;
  bool exclude_each_other(const ProxyRef& a, const ProxyRef& b) const;

  const FeatureComparator& comparator_;
};

} // namespace castor::binding
