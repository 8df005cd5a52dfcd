#include "castor/communication/dialogue/referring_expression.hpp"

#include "castor/communication/dialogue/content.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace castor::communication {

namespace {

using binding::FeatureKind;

struct Property {
  FeatureKind kind;
  const char* mode;
  const char* sort;
};

constexpr std::array properties{Property{FeatureKind::colour, "Colour", "colour"},
                                Property{FeatureKind::shape, "Shape", "shape"},
                                Property{FeatureKind::size, "Size", "size"},
                                Property{FeatureKind::material, "Material", "material"}};

std::string first_word(const SceneKnowledge& scene, const std::string& id, FeatureKind kind) {
  auto words = scene.words(id, kind);
  return words.empty() ? std::string{} : words.front();
}

/// By its shape, if there is a noun for it, else by the most special concept.
std::string noun_of(const SceneKnowledge& scene, const std::string& id) {
  const auto& vocabulary = scene.vocabulary();
  if (const auto shape = first_word(scene, id, FeatureKind::shape); !shape.empty())
    if (auto noun = vocabulary.noun_of_shape(shape); !noun.empty())
      return noun;
  std::string result;
  for (auto& word : scene.words(id, FeatureKind::concept_name))
    if (word != vocabulary.general_concept() &&
        (result.empty() || vocabulary.ontology().is_kind_of(word, result)))
      result = word;
  return vocabulary.noun_of_concept(result.empty() ? vocabulary.general_concept() : result);
}

/// By its own noun, or by one that is more general: a kitchen may be called a room.
bool may_be_called(const SceneKnowledge& scene, const std::string& id, const std::string& noun) {
  if (noun_of(scene, id) == noun)
    return true;
  const auto& vocabulary = scene.vocabulary();
  const auto concepts = scene.words(id, FeatureKind::concept_name);
  return vocabulary.is_of_other_kind(noun) && std::ranges::any_of(concepts, [&](auto& known) {
           return vocabulary.ontology().is_kind_of(known, vocabulary.concept_of(noun));
         });
}

/// The word for a property that is said by an adjective; empty for a shape that has a noun.
std::string adjective(const SceneKnowledge& scene, const std::string& id, FeatureKind kind) {
  auto word = first_word(scene, id, kind);
  const bool has_noun =
    kind == FeatureKind::shape && !scene.vocabulary().noun_of_shape(word).empty();
  return has_noun ? std::string{} : word;
}

LogicalForm with_property(LogicalForm thing, const Property& property, const std::string& word) {
  return with(std::move(thing), property.mode, communication::property(property.sort, word));
}

/// A definite description without a kind of feature; nothing if it is not enough.
std::optional<LogicalForm> told_apart(SceneKnowledge& scene, const std::string& union_id,
                                      std::optional<FeatureKind> besides) {
  const auto thing = scene.vocabulary().noun_of_concept(scene.vocabulary().general_concept());
  auto noun = besides == FeatureKind::shape ? thing : noun_of(scene, union_id);
  auto others = scene.is_thing(union_id) ? scene.things() : scene.individuals();
  std::erase(others, union_id);
  if (noun != thing)
    std::erase_if(others, [&](auto& other) { return !may_be_called(scene, other, noun); });
  auto result = definite(noun);
  for (auto& x : properties) {
    auto word = adjective(scene, union_id, x.kind);
    if (others.empty() || word.empty() || x.kind == besides)
      continue;
    const auto excluded =
      std::erase_if(others, [&](auto& other) { return adjective(scene, other, x.kind) != word; });
    if (excluded > 0)
      result = with_property(std::move(result), x, word);
  }
  return others.empty() ? std::optional{std::move(result)} : std::nullopt;
}

LogicalForm with_properties(const SceneKnowledge& scene, const std::string& union_id,
                            LogicalForm thing) {
  for (auto& x : properties)
    // A size that is not certain is said if it is asked for, or to tell things apart.
    if (auto word = adjective(scene, union_id, x.kind);
        !word.empty() && (x.kind != FeatureKind::size || scene.is_sure(union_id, x.kind)))
      thing = with_property(std::move(thing), x, word);
  return thing;
}

} // namespace

LogicalForm indefinite_description(const SceneKnowledge& scene, const std::string& union_id) {
  return with_properties(scene, union_id, indefinite(noun_of(scene, union_id)));
}

LogicalForm full_description(const SceneKnowledge& scene, const std::string& union_id) {
  return with_properties(scene, union_id, definite(noun_of(scene, union_id)));
}

LogicalForm referring_expression(SceneKnowledge& scene, const std::string& union_id) {
  return told_apart(scene, union_id, std::nullopt)
    .value_or(indefinite_description(scene, union_id));
}

std::optional<LogicalForm> definite_description(SceneKnowledge& scene, const std::string& union_id,
                                                FeatureKind besides) {
  return told_apart(scene, union_id, besides);
}

} // namespace castor::communication
