#include "castor/tests/binding/reference/binding_core.hpp"

#include "castor/binding/binder.hpp"
#include "castor/binding/binding_judge.hpp"
#include "castor/binding/binding_score.hpp"
#include "castor/binding/features.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace castor::binding {

BindingCore::BindingCore(ComparatorOptions options) : comparator_(std::move(options)) {
  // nop
}

// -- what can be asked ----------------------------------------------------------------------------

BindingCore::Node* BindingCore::find(const std::string& id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? nullptr : found->second;
}

const BindingProxy* BindingCore::proxy(const std::string& id) const {
  const auto* node = find(id);
  return node ? &node->proxy : nullptr;
}

std::span<const Port> BindingCore::in_ports(const std::string& id) const {
  const auto found = in_ports_.find(id);
  return found == in_ports_.end() ? std::span<const Port>{} : found->second;
}

std::vector<ProxyRef> BindingCore::bound_with(const std::string& id) const {
  const auto* node = find(id);
  if (!node)
    return {};
  return node->first ? node->first->refs : std::vector{node->ref()};
}

std::string BindingCore::union_of(const std::string& id) const {
  const auto found = union_of_.find(id);
  return found == union_of_.end() ? std::string{} : found->second;
}

BestUnionsForProxy BindingCore::best_unions(const std::string& id) const {
  BestUnionsForProxy result{id, {}};
  if (const auto* node = find(id)) {
    for (const auto& x : node->best)
      result.unions.push_back(union_id_of(x.first->rank.id));
  }
  return result;
}

std::optional<Ambiguity> BindingCore::ambiguity(const std::string& id) const {
  const auto* node = find(id);
  if (!node || node->best.size() < 2 ||
      node->best[0].score.salience_gap < node->best[1].score.salience_gap)
    return std::nullopt;
  const auto best = best_unions(id);
  // The proxy's own contribution to its union does not tell it from the others.
  std::vector<BindingUnion> unions;
  for (const auto& x : node->best) {
    std::vector<ProxyRef> members;
    for (const auto* member : x.first->members) {
      if (member->rank < node->rank)
        members.push_back(member->ref());
    }
    unions.push_back(make_union(members, *this));
  }
  std::vector<const BindingUnion*> pointers;
  for (const auto& x : unions)
    pointers.push_back(&x);
  return describe_ambiguity(best, node->proxy, pointers, comparator_);
}

std::vector<FeatureComparison> BindingCore::open_comparisons(const std::string& id) const {
  std::vector<FeatureComparison> result;
  const auto* node = find(id);
  if (!node)
    return result;
  for (const auto& [rank, other] : nodes_) {
    if (&other == node)
      continue;
    for (auto& x : scorer_.open_comparisons(node->proxy, other.proxy)) {
      const bool known = std::any_of(result.begin(), result.end(), [&](const auto& y) {
        return x.proxy_feature == y.proxy_feature && x.union_feature == y.union_feature;
      });
      if (!known)
        result.push_back(std::move(x));
    }
  }
  return result;
}

// -- changes --------------------------------------------------------------------------------------

BindingChange BindingCore::set(const std::string& id, BindingProxy proxy) {
  if (auto* old = find(id))
    take_out(*old);
  put_in(id, std::move(proxy));
  return propagate();
}

BindingChange BindingCore::remove(const std::string& id) {
  if (auto* old = find(id))
    take_out(*old);
  return propagate();
}

BindingChange BindingCore::add(FeatureComparisonCompetence competence) {
  comparator_.add(std::move(competence));
  invalidate_all();
  return propagate();
}

BindingChange BindingCore::remove_competences(const std::string& subarchitecture) {
  comparator_.remove(subarchitecture);
  invalidate_all();
  return propagate();
}

BindingChange BindingCore::answer(const Feature& a, const Feature& b, Truth equivalent) {
  comparator_.answer(a, b, equivalent);
  for (auto& [rank, node] : nodes_) {
    const auto& features = node.proxy.features;
    const bool says_one = std::any_of(features.begin(), features.end(),
                                      [&](const Feature& x) { return x == a || x == b; });
    if (says_one) {
      invalidate(node);
      invalidate_related(node, nullptr);
    }
  }
  return propagate();
}

void BindingCore::put_in(const std::string& id, BindingProxy proxy) {
  auto rank = rank_of(id, proxy);
  auto& node = nodes_[rank];
  node.rank = std::move(rank);
  node.proxy = std::move(proxy);
  for (auto& port : node.proxy.out_ports)
    port.owner = id;
  node.kinds = kinds_of(node.proxy.features);
  node.beside = comparator_.evidence_beside(node.kinds);
  by_id_[id] = &node;
  touched_proxies_.insert(id);
  link_ports(node);
  invalidate(node);
  invalidate_related(node, nullptr);
}

void BindingCore::take_out(Node& x) {
  invalidate_related(x, nullptr);
  if (x.is_first()) {
    // Those for whom it was the best are among the members.
    for (auto current = nodes_.upper_bound(x.rank); current != nodes_.end(); ++current)
      std::erase_if(current->second.best,
                    [&](const Candidate& candidate) { return candidate.first == &x; });
    dissolve(x);
  } else {
    auto* first = x.first;
    leave(x);
    invalidate_after(x, {first});
    for (const auto* member : first->members)
      invalidate_related(*member, nullptr);
  }
  unlink_ports(x);
  dirty_.erase(&x);
  for (auto& [node, dirty] : dirty_) {
    if (std::erase(dirty.unions, &x) > 0)
      dirty.all = true;
  }
  touched_proxies_.insert(x.rank.id);
  by_id_.erase(x.rank.id);
  nodes_.erase(nodes_.find(x.rank));
}

void BindingCore::update_has_ports(const std::string& id) {
  if (auto* node = find(id))
    node->has_ports = !node->proxy.out_ports.empty() || !in_ports(id).empty();
}

void BindingCore::link_ports(const Node& x) {
  for (const auto& port : x.proxy.out_ports) {
    auto& ports = in_ports_[port.proxy];
    const auto key = [](const Port& p) { return std::tie(p.owner, p.label); };
    const auto place =
      std::upper_bound(ports.begin(), ports.end(), port,
                       [&](const Port& a, const Port& b) { return key(a) < key(b); });
    ports.insert(place, port);
    update_has_ports(port.proxy);
  }
  update_has_ports(x.rank.id);
}

void BindingCore::unlink_ports(const Node& x) {
  for (const auto& port : x.proxy.out_ports) {
    const auto found = in_ports_.find(port.proxy);
    if (found == in_ports_.end())
      continue;
    std::erase_if(found->second, [&](const Port& p) { return p.owner == x.rank.id; });
    if (found->second.empty())
      in_ports_.erase(found);
    update_has_ports(port.proxy);
  }
}

// -- binding --------------------------------------------------------------------------------------

BindingChange BindingCore::propagate() {
  while (!dirty_.empty()) {
    const auto next = dirty_.begin();
    auto& node = *next->first;
    const auto why = std::move(next->second);
    dirty_.erase(next);
    if (why.all) {
      judge_all(node);
    } else {
      for (auto* first : why.unions)
        judge_union(node, *first);
    }
    auto* best = node.best.empty() ? &node : node.best.front().first;
    if (best != node.first)
      move(node, *best);
  }
  return publish();
}

void BindingCore::judge_all(Node& x) {
  x.best.clear();
  for (auto current = nodes_.begin(); &current->second != &x; ++current) {
    auto& first = current->second;
    if (first.is_first() && first.proxy.type == x.proxy.type &&
        (x.beside & first.member_kinds) != 0)
      consider(x, first, scorer_.score(x.ref(), first.refs, *this));
  }
}

void BindingCore::judge_union(Node& x, Node& first) {
  const bool is_there = first.is_first() && first.rank < x.rank;
  const auto score = is_there ? scorer_.score(x.ref(), first.refs, *this) : BindingScore{};
  const auto known = std::find_if(x.best.begin(), x.best.end(), [&](const Candidate& candidate) {
    return candidate.first == &first;
  });
  if (known != x.best.end()) {
    if (x.best.size() == 1 && beats(known->score, score)) {
      judge_all(x);
      return;
    }
    if (beats(known->score, score)) {
      x.best.erase(known);
      return;
    }
    x.best.erase(known);
  }
  consider(x, first, score);
}

void BindingCore::consider(Node& x, Node& first, const BindingScore& score) {
  const auto highest = x.best.empty() ? nil_score() : x.best.front().score;
  const auto order = compare(score, highest);
  if (order < 0 || (order == 0 && x.best.empty()))
    return;
  if (order > 0)
    x.best.clear();
  const auto key = [](const Candidate& c) {
    return std::tie(c.score.salience_gap, c.first->rank.id);
  };
  const Candidate candidate{&first, score};
  const auto place =
    std::upper_bound(x.best.begin(), x.best.end(), candidate,
                     [&](const Candidate& a, const Candidate& b) { return key(a) < key(b); });
  x.best.insert(place, candidate);
}

void BindingCore::move(Node& x, Node& to) {
  auto* from = x.first;
  if (x.is_first())
    dissolve(x);
  else if (from)
    leave(x);
  x.first = &to;
  const auto place = std::upper_bound(to.members.begin(), to.members.end(), &x, ByRank{});
  to.members.insert(place, &x);
  update_members(to);
  touched_proxies_.insert(x.rank.id);
  invalidate_after(x, {from, &to});
  if (from && from != &x) {
    for (const auto* member : from->members)
      invalidate_related(*member, &x);
  }
  for (const auto* member : to.members)
    invalidate_related(*member, &x);
}

void BindingCore::leave(Node& x) {
  auto& first = *std::exchange(x.first, nullptr);
  std::erase(first.members, &x);
  update_members(first);
}

/// The others have to find another union.
void BindingCore::dissolve(Node& first) {
  for (auto* member : std::exchange(first.members, {})) {
    member->first = nullptr;
    if (member != &first)
      invalidate(*member);
  }
  update_members(first);
}

void BindingCore::update_members(Node& first) {
  first.refs.clear();
  first.member_kinds = 0;
  for (const auto* member : first.members) {
    first.refs.push_back(member->ref());
    first.member_kinds |= member->kinds;
  }
  touched_unions_.insert(first.rank.id);
}

BindingChange BindingCore::publish() {
  BindingChange result;
  for (const auto& id : std::exchange(touched_unions_, {})) {
    const auto union_id = union_id_of(id);
    const auto* first = find(id);
    const auto known = unions_.find(union_id);
    if (!first || !first->is_first()) {
      if (known != unions_.end()) {
        unions_.erase(known);
        result.removed.push_back(union_id);
      }
      continue;
    }
    auto now = make_union(first->refs, *this);
    if (known == unions_.end()) {
      unions_.emplace(union_id, std::move(now));
    } else {
      now.updates = known->second.updates;
      if (now == known->second)
        continue;
      ++now.updates;
      known->second = std::move(now);
    }
    result.changed.push_back(union_id);
  }
  for (const auto& id : std::exchange(touched_proxies_, {})) {
    const auto* node = find(id);
    if (!node) {
      union_of_.erase(id);
      continue;
    }
    auto union_id = union_id_of(node->first->rank.id);
    auto& known = union_of_[id];
    if (known != union_id) {
      known = std::move(union_id);
      result.moved.push_back(id);
    }
  }
  return result;
}

} // namespace castor::binding
