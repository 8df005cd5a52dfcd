#include "castor/binding/binding_judge.hpp"

#include "castor/binding/binding_score.hpp"
#include "castor/binding/features.hpp"

#include <algorithm>
#include <bit>
#include <utility>
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

Judgement judge(const std::string& proxy, std::span<const ProxyUnionScore> scores) {
  Judgement result;
  result.best.proxy = result.non_matching.proxy = proxy;
  std::vector<const ProxyUnionScore*> best;
  auto highest = nil_score();
  for (const auto& x : scores) {
    if (x.union_id.empty())
      continue;
    if (does_not_match(x.score))
      result.non_matching.unions.push_back(x.union_id);
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
    result.best.unions.push_back(x->union_id);
  std::sort(result.non_matching.unions.begin(), result.non_matching.unions.end());
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

void BindingJudge::add_union(const std::string& union_id) {
  unions_.insert(union_id);
  for (const auto& [proxy, scores] : scores_)
    looked_at_anew_.insert(proxy);
}

void BindingJudge::remove_union(const std::string& union_id) {
  unions_.erase(union_id);
  for (auto& [proxy, scores] : scores_) {
    scores.erase(union_id);
    looked_at_anew_.insert(proxy);
  }
}

void BindingJudge::add(const ProxyUnionScore& score) {
  scores_[score.proxy][score.union_id] = score.score;
  looked_at_anew_.insert(score.proxy);
}

void BindingJudge::forget(const std::string& proxy) {
  scores_.erase(proxy);
  told_.erase(proxy);
  looked_at_anew_.erase(proxy);
}

std::optional<Judgement> BindingJudge::judgement(const std::string& proxy) const {
  const auto found = scores_.find(proxy);
  if (found == scores_.end() || !found->second.contains({}))
    return std::nullopt;
  std::vector<ProxyUnionScore> scores;
  for (const auto& union_id : unions_) {
    const auto score = found->second.find(union_id);
    if (score == found->second.end())
      return std::nullopt;
    scores.push_back({proxy, union_id, score->second});
  }
  return judge(proxy, scores);
}

std::map<std::string, Judgement> BindingJudge::take_new() {
  std::map<std::string, Judgement> result;
  for (const auto& proxy : std::exchange(looked_at_anew_, {})) {
    auto now = judgement(proxy);
    if (!now)
      continue;
    const auto told = told_.find(proxy);
    if (told != told_.end() && told->second == *now)
      continue;
    told_.insert_or_assign(proxy, *now);
    result.emplace(proxy, std::move(*now));
  }
  return result;
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
