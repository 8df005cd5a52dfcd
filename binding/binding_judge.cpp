#include "castor/binding/binding_judge.hpp"

#include "castor/binding/binding_score.hpp"
#include "castor/binding/features.hpp"

#include <algorithm>
#include <bit>
#include <tuple>
#include <vector>

namespace castor::binding {

namespace {

std::vector<FeatureKind> kinds_in(KindSet kinds) {
  std::vector<FeatureKind> result;
  for (; kinds != 0; kinds &= kinds - 1)
    result.push_back(static_cast<FeatureKind>(std::countr_zero(kinds)));
  return result;
}

} // namespace

BestUnionsForProxy judge(const std::string& proxy, std::span<const ProxyUnionScore> scores) {
  BestUnionsForProxy result{proxy, {}};
  std::vector<const ProxyUnionScore*> best;
  auto highest = nil_score();
  for (const auto& x : scores) {
    if (x.union_id.empty())
      continue;
    const auto order = compare(x.score, highest);
    if (order > 0) {
      best.clear();
      highest = x.score;
    }
    if (order > 0 || (order == 0 && !best.empty()))
      best.push_back(&x);
  }
  std::sort(best.begin(), best.end(), [](const auto* a, const auto* b) {
    return std::tie(a->score.salience_gap, a->union_id) <
           std::tie(b->score.salience_gap, b->union_id);
  });
  for (const auto* x : best)
    result.unions.push_back(x->union_id);
  return result;
}

bool is_ambiguous(const BestUnionsForProxy& best, std::span<const ProxyUnionScore> scores) {
  if (best.unions.size() < 2)
    return false;
  const auto gap_of = [&](const std::string& union_id) {
    const auto found = std::find_if(scores.begin(), scores.end(),
                                    [&](const auto& x) { return x.union_id == union_id; });
    return found == scores.end() ? BindingScore{}.salience_gap : found->score.salience_gap;
  };
  return gap_of(best.unions[0]) >= gap_of(best.unions[1]);
}

Ambiguity describe_ambiguity(const BestUnionsForProxy& best, const BindingProxy& proxy,
                             std::span<const BindingUnion* const> unions,
                             const FeatureComparator& comparator) {
  Ambiguity result;
  result.proxy = best.proxy;
  result.unions = best.unions;
  KindSet by_any = 0;
  KindSet by_all = ~KindSet{0};
  for (const auto* x : unions) {
    by_any |= kinds_of(x->features);
    by_all &= kinds_of(x->features);
  }
  const KindSet by_proxy = kinds_of(proxy.features);
  // Only what can be compared would help.
  const auto evidence = [&](KindSet kinds) { return kinds & comparator.evidence_beside(kinds); };
  result.missing_in_proxy = kinds_in(evidence(by_any) & ~by_proxy);
  result.missing_in_unions = kinds_in(evidence(by_proxy) & ~by_all);
  return result;
}

} // namespace castor::binding
