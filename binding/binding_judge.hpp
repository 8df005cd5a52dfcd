#pragma once

#include "castor/binding/binding_scorer.hpp"
#include "castor/binding/types.hpp"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>

namespace castor::binding {

/// What is to become of a proxy.
struct Judgement {
  BestUnionsForProxy best;
  NonMatchingUnions non_matching;

  friend bool operator==(const Judgement&, const Judgement&) = default;
};

/// The best of these scores of one proxy, which strictly beat NIL; equals in the order of their
/// salience, then of the ids of the unions. The scores need not be ordered, nor contain NIL.
Judgement judge(const std::string& proxy, std::span<const ProxyUnionScore> scores);

/// Whether the first of the best unions is no better than the second, salience included.
bool is_ambiguous(const BestUnionsForProxy& best, std::span<const ProxyUnionScore> scores);

/// Collects scores until there is one of a proxy for every union, and NIL.
class BindingJudge {
public:
  void add_union(const std::string& union_id);
  void remove_union(const std::string& union_id);

  /// The newest score of a proxy and a union counts.
  void add(const ProxyUnionScore& score);

  /// The proxy is gone.
  void forget(const std::string& proxy);

  /// Nothing, as long as scores are missing.
  std::optional<Judgement> judgement(const std::string& proxy) const;

  /// Proxies whose judgement can be made and is another than when this was last asked.
  std::map<std::string, Judgement> take_new();

private:
  std::set<std::string> unions_;
  /// By proxy and union; NIL has the empty id.
  std::map<std::string, std::map<std::string, BindingScore>> scores_;
  std::set<std::string> looked_at_anew_;
  std::map<std::string, Judgement> told_;
};

/// What would tell the unions apart, if the proxy or they said it.
Ambiguity describe_ambiguity(const BestUnionsForProxy& best, const BindingProxy& proxy,
                             std::span<const BindingUnion* const> unions,
                             const FeatureComparator& comparator);

} // namespace castor::binding
