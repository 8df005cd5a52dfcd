#pragma once

#include "castor/binding/types.hpp"
#include "castor/planning/continual/types.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace castor::planning {

/// Words that are facts: "(has-colour ball red)", with an object of the type for each word.
struct WordFacts {
  binding::FeatureKind kind = binding::FeatureKind::colour;
  std::string predicate;
  std::string type;

  friend bool operator==(const WordFacts&, const WordFacts&) = default;
};

/// "colour", or "concept".
/// \throws std::invalid_argument if there is no such feature
binding::FeatureKind feature_named(const std::string& name);

/// "colour=has-colour:colour".
/// \throws std::invalid_argument if it is not understood
WordFacts word_facts(const std::string& rule);

/// In which words of a domain it is told what is bound.
struct UnionFactTerms {
  std::string thing_type = "thing";
  std::string place_type = "waypoint";
  /// State variable: the place of a thing.
  std::string position = "pos";
  /// Predicates by the labels of relations: of a place and the thing that is at the other place, or
  /// of two things.
  std::map<std::string, std::string> relations;
  std::vector<WordFacts> words;
  /// Predicates of a thing of which somebody looked for such a word, and found none.
  std::map<binding::FeatureKind, std::string> unknown;
  /// Number of further places, at which nothing is.
  std::int64_t free_places = 0;
};

/// What there is as far as it is perceived: things, their places, words and relations. Objects are
/// named after proxies, so that they keep their names while things are bound anew.
StateReply facts_of(const binding::ReferenceReply& bound, const UnionFactTerms& terms);

} // namespace castor::planning
