#pragma once

#include "castor/binding/comparators.hpp"
#include "castor/binding/types.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding {

/// Compares features, by the internal comparators and by the answers of subarchitectures that are
/// competent for their kinds. What has been answered once is known from then on; what two proxies
/// have to do with each other therefore follows from them and the answers alone.
class FeatureComparator {
public:
  explicit FeatureComparator(ComparatorOptions options = {});

  void add(FeatureComparisonCompetence competence);
  /// Its answers no longer count where nobody else is competent.
  void remove(const std::string& subarchitecture);

  /// Remembers an answer. One that says unknown changes nothing, but nobody is asked again.
  void answer(const Feature& a, const Feature& b, Truth equivalent);

  /// What is known now.
  Truth compare(const Feature& a, const Feature& b) const;

  /// Whether what is known says all that is described, and not only nothing against it.
  bool confirms(const Feature& known, const Feature& described) const;

  /// Who has to be asked before more is known; nullptr if nobody has.
  const FeatureComparisonCompetence* competent_for(const Feature& a, const Feature& b) const;

  /// Whether the kinds say something about each other, internally or to anybody competent.
  bool is_evidence(FeatureKind a, FeatureKind b) const {
    return (evidence_[static_cast<std::size_t>(a)] & bit(b)) != 0;
  }

  /// The kinds that are evidence beside one of `kinds`.
  KindSet evidence_beside(KindSet kinds) const;

  /// Whether features of these kinds may be anything but unknown to each other.
  bool may_compare(FeatureKind a, FeatureKind b) const {
    return (comparable_[static_cast<std::size_t>(a)] & bit(b)) != 0;
  }

private:
  /// Regardless of the order.
  struct Pair {
    std::string low;
    std::string high;

    friend auto operator<=>(const Pair&, const Pair&) = default;
  };

  static Pair pair_of(const Feature& a, const Feature& b);
  const FeatureComparisonCompetence* competence(FeatureKind a, FeatureKind b) const;
  void look_up_kinds();

  ComparatorOptions options_;
  std::vector<FeatureComparisonCompetence> competences_;
  std::map<Pair, Truth> answers_;
  /// For each kind, those that are evidence beside it, and those that it can be compared with.
  std::array<KindSet, feature_kinds> evidence_{};
  std::array<KindSet, feature_kinds> comparable_{};
};

} // namespace castor::binding
