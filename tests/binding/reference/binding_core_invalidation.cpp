#include "castor/tests/binding/reference/binding_core.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <vector>

// Invalidation: which proxies and unions have to be looked at again after a change.

namespace castor::binding {

void BindingCore::invalidate(Node& x) {
  dirty_[&x].all = true;
}

/// What kinds say of each other has changed.
void BindingCore::invalidate_all() {
  for (auto& [rank, node] : nodes_) {
    node.beside = comparator_.evidence_beside(node.kinds);
    invalidate(node);
  }
}

void BindingCore::invalidate(Node& x, Node& first) {
  auto& unions = dirty_[&x].unions;
  if (std::find(unions.begin(), unions.end(), &first) == unions.end())
    unions.push_back(&first);
}

/// Whether it makes a difference to the one if the other is in a union or not.
bool BindingCore::may_affect(const Node& whom, const Node& what) const {
  if (whom.proxy.type != what.proxy.type)
    return false;
  const ProxyRef members[] = {what.ref()};
  const auto score = scorer_.feature_score(whom.ref(), members);
  // Relations count where something makes both comparable, whoever of the members it is.
  return score.mismatch || score.matches > 0 ||
         (whom.has_ports && (score.comparable || what.has_ports));
}

/// The proxy has come into these unions, or left them.
void BindingCore::invalidate_after(const Node& x, std::initializer_list<Node*> unions) {
  for (auto current = nodes_.upper_bound(x.rank); current != nodes_.end(); ++current) {
    auto& other = current->second;
    std::optional<bool> may;
    for (auto* first : unions) {
      if (!first)
        continue;
      const bool is_choice =
        std::any_of(other.best.begin(), other.best.end(),
                    [&](const Candidate& candidate) { return candidate.first == first; });
      if (!is_choice && !may)
        may = may_affect(other, x);
      if (is_choice || *may)
        invalidate(other, *first);
    }
  }
}

/// Those at the other ends of its relations, and the relations.
std::vector<BindingCore::Node*> BindingCore::related(const Node& x) const {
  std::vector<Node*> result;
  const auto add = [&](const std::string& id) {
    auto* node = find(id);
    if (node && node != &x)
      result.push_back(node);
  };
  for (const auto& port : x.proxy.out_ports)
    add(port.proxy);
  for (const auto& port : in_ports(x.rank.id)) {
    add(port.owner);
    if (const auto* owner = find(port.owner)) {
      for (const auto& end : owner->proxy.out_ports)
        add(end.proxy);
    }
  }
  return result;
}

/// What the proxy is, or whom it is bound with, may tell something of those that it is related to;
/// after a certain proxy if that is all that can be affected.
void BindingCore::invalidate_related(const Node& x, const Node* after) {
  const auto is_after = [&](const Node& y) { return !after || after->rank < y.rank; };
  for (auto* other : related(x)) {
    if (is_after(*other))
      invalidate(*other);
    auto* first = other->first;
    if (!first)
      continue;
    touched_unions_.insert(first->rank.id);
    const auto begin =
      nodes_.upper_bound(after && first->rank < after->rank ? after->rank : first->rank);
    for (auto current = begin; current != nodes_.end(); ++current) {
      auto& later = current->second;
      if ((later.beside & first->member_kinds) != 0 && later.has_ports)
        invalidate(later, *first);
    }
  }
}

} // namespace castor::binding
