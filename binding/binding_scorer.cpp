#include "castor/binding/binding_scorer.hpp"

#include "castor/binding/binding_score.hpp"
#include "castor/binding/features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace castor::binding {

namespace {

/// Whether one of them says that it is not to be bound to anything from the other's source.
bool sources_exclude_each_other(const BindingProxy& a, const BindingProxy& b) {
  const auto refuses = [](const BindingProxy& x, const BindingProxy& y) {
    return std::any_of(x.features.begin(), x.features.end(), [&](const Feature& feature) {
      return feature.kind == FeatureKind::other_source_id && feature.negated &&
             feature.text == y.source;
    });
  };
  return refuses(a, b) || refuses(b, a);
}

struct Interval {
  double begin = 0;
  double end = std::numeric_limits<double>::infinity();
};

/// When the proxy is salient; when it was made, if nobody says more.
std::optional<Interval> salient(const BindingProxy& proxy) {
  if (const auto* x = find_feature(proxy.features, FeatureKind::salience);
      x && !x->numbers.empty()) {
    Interval result{x->numbers[0]};
    if (x->numbers.size() > 1)
      result.end = x->numbers[1];
    return result;
  }
  if (const auto* x = find_feature(proxy.features, FeatureKind::creation_time);
      x && !x->numbers.empty())
    return Interval{x->numbers[0], x->numbers[0]};
  return std::nullopt;
}

double gap(const Interval& a, const Interval& b) {
  return std::max({0.0, a.begin - b.end, b.begin - a.end});
}

/// Salience proper on one side is needed: that two things were made at one time says nothing.
double salience_gap(const BindingProxy& a, const BindingProxy& b) {
  const double none = BindingScore{}.salience_gap;
  if (!find_feature(a.features, FeatureKind::salience) &&
      !find_feature(b.features, FeatureKind::salience))
    return none;
  const auto first = salient(a);
  const auto second = salient(b);
  return first && second ? std::min(none, gap(*first, *second)) : none;
}

bool same_labels(const BindingProxy& a, const BindingProxy& b) {
  return std::is_permutation(a.out_ports.begin(), a.out_ports.end(), b.out_ports.begin(),
                             b.out_ports.end(),
                             [](const Port& x, const Port& y) { return x.label == y.label; });
}

} // namespace

void BindingScorer::add_features(const BindingProxy& proxy, const BindingProxy& member,
                                 KindSet& matched, BindingScore& score) const {
  if (sources_exclude_each_other(proxy, member))
    score.mismatch = true;
  for (const auto& own : proxy.features) {
    for (const auto& other : member.features) {
      if (!comparator_.may_compare(own.kind, other.kind))
        continue;
      const Truth truth = comparator_.compare(own, other);
      if (truth == Truth::no)
        score.mismatch = true;
      if (!comparator_.is_evidence(own.kind, other.kind))
        continue;
      score.comparable = true;
      // That something is not red says little for its being the thing that is blue.
      if (truth == Truth::yes && !own.negated && !other.negated)
        matched |= bit(own.kind);
    }
  }
}

BindingScore BindingScorer::feature_score(const ProxyRef& proxy,
                                          std::span<const ProxyRef> members) const {
  BindingScore result;
  KindSet matched = 0;
  for (const auto& member : members) {
    if (!precedes(member, proxy))
      continue;
    if (member.proxy->type != proxy.proxy->type)
      return {};
    add_features(*proxy.proxy, *member.proxy, matched, result);
    result.salience_gap = std::min(result.salience_gap, salience_gap(*proxy.proxy, *member.proxy));
  }
  for (; matched != 0; matched &= matched - 1)
    ++result.matches;
  return result;
}

BindingScore BindingScorer::score(const ProxyRef& proxy, std::span<const ProxyRef> members,
                                  const RelationContext& context) const {
  auto result = feature_score(proxy, members);
  // What features rule out, relations do not bring back.
  if (result.comparable && !result.mismatch)
    add_relations(proxy, members, context, result);
  return result;
}

bool BindingScorer::exclude_each_other(const ProxyRef& a, const ProxyRef& b) const {
  if (a.proxy->type != b.proxy->type)
    return true;
  KindSet matched = 0;
  BindingScore score;
  add_features(*a.proxy, *b.proxy, matched, score);
  return score.mismatch;
}

/// For those that are bound before the judged one, what counts is what became of them; for others,
/// what they say.
Truth BindingScorer::same_thing(const ProxyRef& judged, const std::string& a, const std::string& b,
                                const RelationContext& context) const {
  if (a == b)
    return Truth::yes;
  const ProxyRef first{&a, context.proxy(a)};
  const ProxyRef second{&b, context.proxy(b)};
  if (!first.proxy || !second.proxy)
    return Truth::unknown;
  if (!precedes(first, judged) || !precedes(second, judged)) {
    if (exclude_each_other(first, second))
      return Truth::no;
    KindSet matched = 0;
    BindingScore score;
    add_features(*first.proxy, *second.proxy, matched, score);
    return matched != 0 ? Truth::yes : Truth::unknown;
  }
  const auto mine = context.bound_with(a);
  const auto theirs = context.bound_with(b);
  for (const auto& x : mine) {
    if (*x.id == b)
      return Truth::yes;
  }
  for (const auto& x : mine) {
    for (const auto& y : theirs) {
      if (precedes(x, judged) && precedes(y, judged) && exclude_each_other(x, y))
        return Truth::no;
    }
  }
  return Truth::unknown;
}

/// Whether two relations that lead here and there are one, as far as it can be seen from their
/// other ends. Never no: something may well be left of two things.
Truth BindingScorer::relation_between(const ProxyRef& proxy, const Port& own, const Port& other,
                                      const RelationContext& context) const {
  if (own.label != other.label || own.owner == other.owner)
    return Truth::unknown;
  const auto* mine = context.proxy(own.owner);
  const auto* theirs = context.proxy(other.owner);
  if (!mine || !theirs)
    return Truth::unknown;
  const auto* my_label = find_feature(mine->features, FeatureKind::relation_label);
  const auto* their_label = find_feature(theirs->features, FeatureKind::relation_label);
  if (!my_label || !their_label || comparator_.compare(*my_label, *their_label) != Truth::yes)
    return Truth::unknown;
  for (const auto& x : mine->out_ports) {
    for (const auto& y : theirs->out_ports) {
      if (x.label != own.label && x.label == y.label &&
          same_thing(proxy, x.proxy, y.proxy, context) == Truth::yes)
        return Truth::yes;
    }
  }
  return Truth::unknown;
}

void BindingScorer::add_relations(const ProxyRef& proxy, std::span<const ProxyRef> members,
                                  const RelationContext& context, BindingScore& score) const {
  for (const auto& port : proxy.proxy->out_ports) {
    bool matches = false;
    for (const auto& member : members) {
      if (!precedes(member, proxy))
        continue;
      if (!same_labels(*proxy.proxy, *member.proxy))
        score.relation_mismatch = true;
      for (const auto& other : member.proxy->out_ports) {
        if (other.label != port.label)
          continue;
        const Truth truth = same_thing(proxy, port.proxy, other.proxy, context);
        score.relation_mismatch |= truth == Truth::no;
        matches |= truth == Truth::yes;
      }
    }
    score.relation_matches += matches ? 1 : 0;
  }
  for (const auto& port : context.in_ports(*proxy.id)) {
    const bool matches = std::any_of(members.begin(), members.end(), [&](const ProxyRef& member) {
      const auto ports = context.in_ports(*member.id);
      return precedes(member, proxy) &&
             std::any_of(ports.begin(), ports.end(), [&](const Port& other) {
               return relation_between(proxy, port, other, context) == Truth::yes;
             });
    });
    score.relation_matches += matches ? 1 : 0;
  }
}

std::vector<FeatureComparison> BindingScorer::open_comparisons(const BindingProxy& proxy,
                                                               const BindingProxy& member) const {
  std::vector<FeatureComparison> result;
  if (proxy.type != member.type)
    return result;
  for (const auto& own : proxy.features) {
    for (const auto& other : member.features) {
      if (comparator_.competent_for(own, other))
        result.push_back({own, other, Truth::unknown, false});
    }
  }
  return result;
}

} // namespace castor::binding
