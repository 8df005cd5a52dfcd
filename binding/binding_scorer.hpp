#pragma once

#include "castor/binding/binding_order.hpp"
#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/types.hpp"

#include <span>
#include <string>
#include <vector>

namespace castor::binding {

/// A proxy by its id. Whoever keeps it keeps both.
struct ProxyRef {
  const std::string* id = nullptr;
  const BindingProxy* proxy = nullptr;
};

/// Whether the one is bound before the other.
inline bool precedes(const ProxyRef& a, const ProxyRef& b) {
  return precedes(*a.id, *a.proxy, *b.id, *b.proxy);
}

/// What the scorer has to know of a proxy's relations: what is on working memory besides the proxy
/// and the union in question.
class RelationContext {
public:
  virtual ~RelationContext() = default;

  /// The proxy of that id; nullptr if it is not (or not yet) there.
  virtual const BindingProxy* proxy(const std::string& id) const = 0;

  /// The relations that lead to a proxy.
  virtual std::span<const Port> in_ports(const std::string& id) const = 0;

  /// Those that are bound together with the proxy, itself included.
  virtual std::vector<ProxyRef> bound_with(const std::string& id) const = 0;
};

/// Scores proxies against unions, by section 5.2 of the original's rules (docs/binding.md).
class BindingScorer {
public:
  explicit BindingScorer(const FeatureComparator& comparator) : comparator_(comparator) {}

  /// How well the proxy fits to the members of a union.
  ///
  /// \param members in any order. Those that do not come before the proxy in binding order are left
  ///        out; if no one is left, the union is not comparable.
  BindingScore score(const ProxyRef& proxy, std::span<const ProxyRef> members,
                     const RelationContext& context) const;

  /// The part of the score that features and types make up.
  BindingScore feature_score(const ProxyRef& proxy, std::span<const ProxyRef> members) const;

  /// What others should be asked before that score is certain.
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
