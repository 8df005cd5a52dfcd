#include "castor/communication/dialogue/vocabulary.hpp"

#include <algorithm>
#include <utility>

namespace castor::communication {

namespace {

using binding::Feature;
using binding::FeatureKind;

std::optional<FeatureKind> kind_called(std::string_view name) {
  static constexpr auto reflection = reflection_of<FeatureKind>();
  for (const auto& [known, kind] : reflection.enumerators)
    if (known == name)
      return kind;
  return std::nullopt;
}

template <class Map>
const typename Map::mapped_type* find_in(const Map& map, std::string_view word) {
  const auto found = map.find(word);
  return found == map.end() ? nullptr : &found->second;
}

} // namespace

Vocabulary::Vocabulary(std::shared_ptr<const Lexicon> lexicon,
                       std::shared_ptr<const Ontology> ontology)
  : lexicon_(std::move(lexicon)), ontology_(std::move(ontology)) {
  if (!meanings().general.empty())
    general_concept_ = meanings().general.front();
  for (const auto name : ontology_->names())
    nouns_.emplace(name, meaning_of(std::string{name}));
  for (const auto& [noun, name] : meanings().concepts)
    nouns_.insert_or_assign(noun, meaning_of(name));
}

Vocabulary::NounMeaning Vocabulary::meaning_of(const std::string& name) const {
  NounMeaning result;
  result.concept_name = name;
  for (const auto& x : ontology_->definition(name))
    if (const auto kind = kind_called(x.property)) {
      result.definition.push_back(binding::feature(*kind, x.value));
      if (kind == FeatureKind::shape)
        result.shape = x.value;
    }
  result.is_of_general_kind = ontology_->is_kind_of(name, general_concept_);
  result.is_of_other_kind = ontology_->excludes(name, general_concept_);
  return result;
}

const Vocabulary::NounMeaning* Vocabulary::find(std::string_view noun) const {
  return find_in(nouns_, noun);
}

// -- nouns

const std::string& Vocabulary::concept_of(const std::string& noun) const {
  const auto* known = find(noun);
  return known == nullptr ? noun : known->concept_name;
}

bool Vocabulary::is_general(std::string_view noun) const {
  // These stand for a noun, and for what is asked for.
  return noun == "one" || noun == "what" ||
         std::ranges::find(meanings().general, noun) != meanings().general.end();
}

const std::vector<Feature>& Vocabulary::definition(std::string_view noun) const {
  static const std::vector<Feature> none;
  const auto* known = find(noun);
  return known == nullptr ? none : known->definition;
}

std::optional<std::string> Vocabulary::shape_of(std::string_view noun) const {
  const auto* known = find(noun);
  return known == nullptr ? std::nullopt : known->shape;
}

std::string Vocabulary::noun_of_shape(const std::string& shape) const {
  return std::string{ontology_->defined_by({"shape", shape})};
}

bool Vocabulary::is_perceptible(std::string_view noun) const {
  return is_general(noun) || !definition(noun).empty();
}

bool Vocabulary::is_of_general_kind(const std::string& noun) const {
  const auto* known = find(noun);
  return is_general(noun) || (known != nullptr && known->is_of_general_kind);
}

bool Vocabulary::is_of_other_kind(const std::string& noun) const {
  const auto* known = find(noun);
  return known != nullptr && known->is_of_other_kind;
}

std::string Vocabulary::kind_noun(const std::string& noun) const {
  const auto& name = concept_of(noun);
  const auto& parents = ontology_->parents(name);
  return parents.empty() || ontology_->has_kinds(name) ? noun : noun_of_concept(parents.front());
}

std::string Vocabulary::noun_of_concept(const std::string& name) const {
  for (const auto& [noun, known] : meanings().concepts)
    if (known == name)
      return noun;
  return name;
}

bool Vocabulary::is_content(std::string_view noun) const {
  return noun == "what" || meanings().contents.contains(noun);
}

// -- properties

std::optional<FeatureKind> Vocabulary::kind_of_quality(std::string_view name) const {
  const auto* kind = find_in(meanings().qualities, name);
  return kind == nullptr ? std::nullopt : kind_called(*kind);
}

std::optional<std::string> Vocabulary::value_of(std::string_view sort,
                                                const std::string& adjective) const {
  const auto* values = find_in(meanings().values, sort);
  if (values == nullptr)
    return adjective;
  const auto* value = find_in(*values, adjective);
  return value == nullptr ? std::nullopt : std::optional{*value};
}

const WordMeanings::Look* Vocabulary::look(std::string_view word) const {
  return find_in(meanings().looks, word);
}

// -- places

std::optional<std::string> Vocabulary::relation_of(std::string_view word) const {
  const auto* label = find_in(meanings().relations, word);
  return label == nullptr ? std::nullopt : std::optional{*label};
}

bool Vocabulary::is_spatial_relation(std::string_view label) const {
  return std::ranges::any_of(meanings().relations, [&](auto& x) { return x.second == label; });
}

const WordMeanings::Surroundings* Vocabulary::surroundings(const Nominal& phrase) const {
  const auto found = std::ranges::find(meanings().surroundings, phrase.proposition,
                                       &WordMeanings::Surroundings::noun);
  return found == meanings().surroundings.end() ? nullptr : &*found;
}

const WordMeanings::Surroundings* Vocabulary::main_surroundings() const {
  return meanings().surroundings.empty() ? nullptr : &meanings().surroundings.front();
}

const WordMeanings::Side* Vocabulary::side(std::string_view noun) const {
  return find_in(meanings().sides, noun);
}

} // namespace castor::communication
