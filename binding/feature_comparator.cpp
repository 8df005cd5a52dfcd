#include "castor/binding/feature_comparator.hpp"

#include "castor/wm/values/encoding.hpp"

#include <algorithm>
#include <bit>

namespace castor::binding {

namespace {

Trust trust_in(const FeatureComparisonCompetence& competence, Truth internal) {
  switch (internal) {
    case Truth::yes:
      return competence.trust_yes;
    case Truth::no:
      return competence.trust_no;
    case Truth::unknown:
      break;
  }
  return competence.trust_unknown;
}

std::string bytes_of(const Feature& x) {
  Bytes bytes;
  Encoder{bytes}.put_fields(x);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace

FeatureComparator::Pair FeatureComparator::pair_of(const Feature& a, const Feature& b) {
  Pair result{bytes_of(a), bytes_of(b)};
  if (result.high < result.low)
    std::swap(result.low, result.high);
  return result;
}

const FeatureComparisonCompetence* FeatureComparator::competence(FeatureKind a,
                                                                 FeatureKind b) const {
  for (const auto& x : competences_) {
    if ((x.proxy_kind == a && x.union_kind == b) || (x.proxy_kind == b && x.union_kind == a))
      return &x;
  }
  return nullptr;
}

FeatureComparator::FeatureComparator(ComparatorOptions options) : options_(std::move(options)) {
  look_up_kinds();
}

void FeatureComparator::add(FeatureComparisonCompetence competence) {
  // By name, so that it does not matter who came first.
  const auto place = std::upper_bound(
    competences_.begin(), competences_.end(), competence,
    [](const auto& x, const auto& y) { return x.subarchitecture < y.subarchitecture; });
  competences_.insert(place, std::move(competence));
  look_up_kinds();
}

void FeatureComparator::remove(const std::string& subarchitecture) {
  std::erase_if(competences_, [&](const auto& x) { return x.subarchitecture == subarchitecture; });
  look_up_kinds();
}

void FeatureComparator::answer(const Feature& a, const Feature& b, Truth equivalent) {
  answers_[pair_of(a, b)] = equivalent;
}

Truth FeatureComparator::compare(const Feature& a, const Feature& b) const {
  const Truth internal = binding::compare(a, b, options_);
  const auto* competent = competence(a.kind, b.kind);
  if (!competent)
    return internal;
  const Trust trust = trust_in(*competent, internal);
  if (trust == Trust::completely)
    return internal;
  const auto answered = answers_.find(pair_of(a, b));
  if (answered != answers_.end() && answered->second != Truth::unknown)
    return answered->second;
  return trust == Trust::not_at_all ? Truth::unknown : internal;
}

bool FeatureComparator::confirms(const Feature& known, const Feature& described) const {
  // What is no mug agrees with a toy, but need not be one.
  const bool only_agrees = known.negated && !described.negated;
  return !only_agrees && compare(described, known) == Truth::yes &&
         !is_more_general(known, described, options_);
}

const FeatureComparisonCompetence* FeatureComparator::competent_for(const Feature& a,
                                                                    const Feature& b) const {
  const auto* competent = competence(a.kind, b.kind);
  if (!competent || trust_in(*competent, binding::compare(a, b, options_)) == Trust::completely ||
      answers_.contains(pair_of(a, b)))
    return nullptr;
  return competent;
}

KindSet FeatureComparator::evidence_beside(KindSet kinds) const {
  KindSet result = 0;
  for (; kinds != 0; kinds &= kinds - 1)
    result |= evidence_[static_cast<std::size_t>(std::countr_zero(kinds))];
  return result;
}

void FeatureComparator::look_up_kinds() {
  for (std::size_t i = 0; i < feature_kinds; ++i) {
    evidence_[i] = comparable_[i] = 0;
    for (std::size_t j = 0; j < feature_kinds; ++j) {
      const auto a = static_cast<FeatureKind>(i);
      const auto b = static_cast<FeatureKind>(j);
      const bool others = competence(a, b) != nullptr;
      if (others || binding::is_evidence(a, b))
        evidence_[i] |= bit(b);
      if (others || binding::may_compare(a, b))
        comparable_[i] |= bit(b);
    }
  }
}

} // namespace castor::binding
