#pragma once

#include "castor/base/ontology.hpp"
#include "castor/binding/types.hpp"
#include "castor/communication/parsing/lexicon.hpp"
#include "castor/communication/types.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

/// What the words of logical forms stand for, in binding's terms: the meanings of a lexicon, with
/// the ontology by which binding compares concepts. Immutable.
class Vocabulary {
public:
  Vocabulary(std::shared_ptr<const Lexicon> lexicon, std::shared_ptr<const Ontology> ontology);

  const std::shared_ptr<const Lexicon>& lexicon() const { return lexicon_; }
  const Ontology& ontology() const { return *ontology_; }

  // -- nouns

  /// The concept that a noun stands for.
  const std::string& concept_of(const std::string& noun) const;

  /// Whether the noun says nothing but that there is something: "thing", "one".
  bool is_general(std::string_view noun) const;

  /// The concept of what such nouns stand for.
  const std::string& general_concept() const { return general_concept_; }

  /// The features that whatever is called so has, such as a shape; empty if its concept is not
  /// defined by features.
  const std::vector<binding::Feature>& definition(std::string_view noun) const;

  /// Binding's word for the shape that a noun stands for; nothing for others.
  std::optional<std::string> shape_of(std::string_view noun) const;

  /// The noun for what has a shape; empty if there is none.
  std::string noun_of_shape(const std::string& shape) const;

  /// Whether perception has words for what a noun stands for: what is called otherwise may be
  /// called so too.
  bool is_perceptible(std::string_view noun) const;

  /// Whether what the noun stands for is of the general kind.
  bool is_of_general_kind(const std::string& noun) const;

  /// Whether nothing that the noun stands for is of the general kind: a kitchen is no thing.
  bool is_of_other_kind(const std::string& noun) const;

  /// The noun for the kind that is spoken of: "room" for "kitchen"; the noun itself if it has kinds
  /// or is a kind of nothing.
  std::string kind_noun(const std::string& noun) const;

  /// A noun for a concept: that of the lexicon, or its name.
  std::string noun_of_concept(const std::string& name) const;

  /// Whether the noun means what is in containers, where things contain others.
  bool is_content(std::string_view noun) const;

  // -- properties

  /// The kind of feature for a quality ("colour", "size") or a sort of property; nothing if binding
  /// has none.
  std::optional<binding::FeatureKind> kind_of_quality(std::string_view name) const;

  /// Binding's word for an adjective of that sort; nothing if it has none.
  std::optional<std::string> value_of(std::string_view sort, const std::string& adjective) const;

  /// What looks like that; null for other words.
  const WordMeanings::Look* look(std::string_view word) const;

  // -- places

  /// Binding's label of the relation that a word of a region stands for ("next_to" is "near");
  /// nothing for others.
  std::optional<std::string> relation_of(std::string_view word) const;

  /// Whether binding has such relations wherever two things have places.
  bool is_spatial_relation(std::string_view label) const;

  /// Where everything is that the robot perceives; null for other nouns.
  const WordMeanings::Surroundings* surroundings(const Nominal& phrase) const;

  /// What the robot calls that; null if there are no words for it.
  const WordMeanings::Surroundings* main_surroundings() const;

  /// The sides of containers that a noun stands for; null for others.
  const WordMeanings::Side* side(std::string_view noun) const;

  // -- who is spoken to

  /// Concept of who is spoken to; empty if there is none.
  const std::string& addressee() const { return meanings().addressee; }

  const WordMeanings& meanings() const { return lexicon_->meanings(); }

private:
  struct NounMeaning {
    std::string concept_name;
    std::vector<binding::Feature> definition;
    std::optional<std::string> shape;
    bool is_of_general_kind = false;
    bool is_of_other_kind = false;
  };

  const NounMeaning* find(std::string_view noun) const;
  NounMeaning meaning_of(const std::string& name) const;

  std::shared_ptr<const Lexicon> lexicon_;
  std::shared_ptr<const Ontology> ontology_;
  std::string general_concept_;
  std::map<std::string, NounMeaning, std::less<>> nouns_;
};

} // namespace castor::communication
