#pragma once

#include "castor/binding/comparators.hpp"
#include "castor/binding/types.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::binding {

/// Compares features with the internal comparators and the answers of subarchitectures that are
/// competent for their kinds. Answers are remembered, so the comparison of two proxies depends only
/// on their features and the answers.
class FeatureComparator {
public:
  explicit FeatureComparator(ComparatorOptions options = {});

  /// From now on concepts are compared by this ontology.
  void set_ontology(std::shared_ptr<const Ontology> ontology) {
    options_.ontology = std::move(ontology);
  }

  void add(FeatureComparisonCompetence competence);
  /// Removes a subarchitecture's competences. Its answers no longer count for kinds without another
  /// competent one.
  void remove(const std::string& subarchitecture);

  /// Remembers an answer. The answer unknown changes no comparison, but prevents further requests.
  void answer(const Feature& a, const Feature& b, Truth equivalent);

  /// Result from all current knowledge.
  Truth compare(const Feature& a, const Feature& b) const;

  /// Whether the known feature implies the described one, beyond not contradicting it.
  bool confirms(const Feature& known, const Feature& described) const;

  /// The competent subarchitecture to ask; nullptr if none is needed.
  const FeatureComparisonCompetence* competent_for(const Feature& a, const Feature& b) const;

  /// Whether agreeing features of these kinds are evidence, by the internal comparators or a
  /// competent subarchitecture.
  bool is_evidence(FeatureKind a, FeatureKind b) const {
    return (evidence_[static_cast<std::size_t>(a)] & bit(b)) != 0;
  }

  /// The kinds that are evidence together with one of `kinds`.
  KindSet evidence_beside(KindSet kinds) const;

  /// Whether the comparison of features of these kinds can have a result other than unknown.
  bool may_compare(FeatureKind a, FeatureKind b) const {
    return (comparable_[static_cast<std::size_t>(a)] & bit(b)) != 0;
  }

private:
  /// Unordered pair of features, as text.
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
  /// For each kind: the kinds that are evidence together with it, and those that it can be compared
  /// with.
  std::array<KindSet, feature_kinds> evidence_{};
  std::array<KindSet, feature_kinds> comparable_{};
};

} // namespace castor::binding
