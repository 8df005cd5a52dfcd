#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/referring_expression.hpp"
#include "castor/communication/dialogue/responder.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <utility>

namespace castor::communication {

namespace {

using binding::FeatureKind;

Response answer(LogicalForm content, LogicalForm simpler = {}) {
  return {RhetoricalRelation::answer, {{std::move(content), std::move(simpler)}}, {}, {}};
}

bool is_count(const Nominal& x) {
  return std::ranges::any_of(x.relations,
                             [](auto& relation) { return relation.mode == "Quantity"; });
}

Nominal affirmed(Nominal x) {
  std::erase_if(x.features, [](auto& feature) { return feature.name == "Polarity"; });
  return x;
}

/// Its attribute that says what the scope of an ascription says; null if there is none.
const char* attribute_mode(const Nominal& scope) {
  if (is_negated(scope))
    return nullptr;
  if (scope.sort == "region")
    return "Location";
  if (scope.sort == "colour")
    return "Colour";
  if (scope.sort == "size")
    return "Size";
  if (scope.sort == "material")
    return "Material";
  return scope.sort == "shape" ? "Shape" : nullptr;
}

} // namespace

/// "The number of balls", "its colour".
Response Responder::owned_quality(const Nominal& x) {
  auto& owner = need(x, "Owner");
  if (x.proposition == "number")
    return count(evaluation_.described(owner), owner, nullptr);
  return quality(x.proposition, owner);
}

Response Responder::to_question_w() {
  if (root().sort == "quality")
    return owned_quality(root());
  auto& asked = need(root(), "Wh-Restr");
  if (root().sort == "existence" && asked.sort == "quality")
    return owned_quality(asked);
  if (asked.sort == "person" || asked.proposition == "who")
    return answer(i_do_not_know());
  if (root().sort != "ascription")
    return about(asked);
  const auto* restriction = dependent(form_, root(), "Cop-Restr");
  const auto* scope = dependent(form_, root(), "Cop-Scope");
  if (restriction == nullptr || scope == nullptr)
    throw Uninterpretable{Uninterpretable::Reason::word, root().proposition};
  const bool asks_for_scope = asked.name == scope->name;
  const auto& other = asks_for_scope ? *restriction : *scope;
  if (asked.sort == "region")
    return where(other);
  if (asked.sort == "quality")
    return quality(asked.proposition, other);
  if (asked.sort == "entity" && other.sort == "quality") {
    // "What is the colour of the ball?"
    return owned_quality(other);
  }
  // "What is the ball made of?"
  if (other.sort == "composition" || restriction->sort == "composition" ||
      scope->sort == "composition")
    throw Uninterpretable{Uninterpretable::Reason::word, "made of"};
  // "What is this?", "which is the largest thing?"
  if (asked.sort == "entity" && other.sort == "thing" && !is_negated(root()) &&
      (is_definite(other) || asks_for_scope))
    return what(other);
  return about(asked);
}

/// Of which things the whole question is true.
Response Responder::about(const Nominal& asked) {
  auto found = evaluation_.answers(root(), asked);
  const auto* scope = root().sort == "ascription" ? dependent(form_, root(), "Cop-Scope") : nullptr;
  if (is_count(asked))
    return count(found, asked, scope);
  // Of things that are as large as one another, any may be the largest.
  const bool is_about_order =
    scope != nullptr &&
    (scope->sort == "selection" || dependent(form_, *scope, "Selection") != nullptr);
  const bool is_tie = is_about_order && found.possible.size() > 1;
  if (found.certain.empty() && !found.possible.empty() && !is_tie)
    return answer(i_do_not_know());
  return list(found.certain.empty() ? found.possible : found.certain);
}

Response Responder::count(const Fitting& found, const Nominal& phrase, const Nominal* scope) {
  const auto number = found.count();
  if (number.certain == 0 && number.possible > 0)
    return answer(i_do_not_know());
  auto thing = part_of(form_, phrase.name);
  auto simpler = exists(counted(number, indefinite("thing")));
  const auto* mode = scope == nullptr ? nullptr : attribute_mode(*scope);
  if (mode != nullptr && !is_negated(root()))
    thing = with(std::move(thing), mode, part_of(form_, scope->name));
  else if (scope != nullptr)
    return answer(simpler);
  return answer(exists(counted(number, std::move(thing))), std::move(simpler));
}

Response Responder::list(const Things& things) const {
  if (things.empty())
    return answer(exists(none_of(indefinite("thing"))));
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  for (auto& id : things)
    result.sentences.push_back({exists(indefinite_description(scene_, id))});
  return result;
}

Response Responder::quality(const std::string& name, const Nominal& of) {
  if (name == "name" || name == "kind")
    return what(of);
  auto kind = kind_of_quality(name);
  if (!kind)
    throw Uninterpretable{Uninterpretable::Reason::word, name};
  Things things;
  if (of.sort == "conjunction") {
    for (const auto* mode : {"First", "Next"})
      for (auto& id : evaluation_.meant(need(of, mode)))
        things.push_back(id);
  } else
    things = evaluation_.meant(of);
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  for (auto& id : things) {
    auto words = scene_.words(id, *kind);
    auto thing = things.size() == 1 ? pronoun("it") : referring_expression(scene_, id);
    if (words.empty())
      return answer(i_do_not_know());
    const bool has_noun = *kind == FeatureKind::shape && words.front() != "round";
    auto value = has_noun ? indefinite(words.front()) : property(name, words.front());
    auto sentence = ascribe(thing, value);
    result.sentences.push_back(
      {scene_.is_sure(id, *kind) ? std::move(sentence) : unsure(std::move(sentence))});
  }
  return result;
}

Response Responder::what(const Nominal& phrase) {
  auto things = evaluation_.meant(phrase);
  if (things.size() != 1)
    return list(things);
  auto sentence = ascribe(pronoun("it"), indefinite_description(scene_, things.front()));
  return answer(scene_.is_sure(things.front(), FeatureKind::shape) ? std::move(sentence)
                                                                   : unsure(std::move(sentence)));
}

Response Responder::where(const Nominal& phrase) {
  // Where people are, the table does not tell.
  if (phrase.sort == "person")
    return answer(i_do_not_know());
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  auto things = evaluation_.meant(phrase);
  for (auto& id : things) {
    auto thing = things.size() == 1 ? pronoun("it") : referring_expression(scene_, id);
    auto facts = scene_.spatial_facts(id);
    auto best = std::ranges::find_if(facts, [](auto& fact) { return fact.relation != "near"; });
    if (best == facts.end())
      best = facts.begin();
    auto place = best == facts.end()
                   ? region("on", definite("table"))
                   : region(best->relation, referring_expression(scene_, best->landmark));
    result.sentences.push_back({ascribe(thing, place)});
  }
  return result;
}

// -- yes or no

Response Responder::yes_or_no(Truth truth) {
  if (truth == Truth::unknown)
    return answer(i_do_not_know());
  return answer(marker(truth == Truth::yes ? "yes" : "no"));
}

Response Responder::to_question_yn() {
  const auto* restriction = dependent(form_, root(), "Cop-Restr");
  const auto* scope = dependent(form_, root(), "Cop-Scope");
  // "Is it red or blue?"
  if (root().sort == "ascription" && restriction != nullptr && scope != nullptr &&
      scope->sort == "conjunction" && scope->proposition == "or" && is_definite(*restriction) &&
      !is_plural(*restriction))
    return choice(*restriction, *scope);
  // "Isn't it red?" asks whether it is; "it is not red, right?", whether it is not.
  const bool is_negative = is_negated(root());
  const bool is_literal = feature(root(), "Literal") == "true";
  auto truth = evaluation_.clause(is_negative && !is_literal ? affirmed(root()) : root());
  if (truth == Truth::unknown) {
    // What vision has no word for may be there, but it is not seen.
    const auto* subject =
      root().sort == "existence" ? dependent(form_, root(), "Subject") : nullptr;
    if (subject != nullptr && subject->sort == "thing" && !is_general_noun(subject->proposition) &&
        !is_pronoun(*subject) && !shape_of_noun(subject->proposition))
      return answer(nothing_like(*subject));
    return yes_or_no(truth);
  }
  if (root().sort != "ascription" || restriction == nullptr || scope == nullptr ||
      !is_definite(*restriction) || is_plural(*restriction) || restriction->sort != "thing" ||
      !feature(*restriction, "Focus").empty())
    return yes_or_no(truth);
  auto things = evaluation_.meant(*restriction);
  if (truth == Truth::yes && things.size() == 1 && !is_sure(things.front(), *scope))
    return answer(unsure(ascribe(pronoun("it"), part_of(form_, scope->name))), marker("yes"));
  if (truth == Truth::no && things.size() == 1 && kind_of_quality(scope->sort) &&
      !is_negated(*scope) && !scene_.words(things.front(), *kind_of_quality(scope->sort)).empty())
    return answer(with_marker("no", as_it_is(things.front(), pronoun("it"), *scope)));
  if (is_negative)
    return answer(with_marker(truth == Truth::yes ? "yes" : "no",
                              ascribe(pronoun("it"), part_of(form_, scope->name),
                                      (truth == Truth::yes) != is_literal)),
                  marker(truth == Truth::yes ? "yes" : "no"));
  return yes_or_no(truth);
}

/// Whether what a scope says of a thing is certain.
bool Responder::is_sure(const std::string& id, const Nominal& scope) const {
  auto kind = scope.sort == "thing" ? FeatureKind::shape : kind_of_quality(scope.sort);
  return !kind || scene_.is_sure(id, *kind);
}

/// Says which of them is so.
Response Responder::choice(const Nominal& subject, const Nominal& alternatives) {
  auto things = evaluation_.meant(subject);
  if (things.empty())
    return answer(i_do_not_know());
  auto& id = things.front();
  std::vector<const Nominal*> so;
  bool is_clear = true;
  for (const auto* mode : {"First", "Next"}) {
    auto& one = need(alternatives, mode);
    auto truth = evaluation_.is(id, one, &subject);
    is_clear = is_clear && truth != Truth::unknown;
    if (truth == Truth::yes)
      so.push_back(&one);
  }
  if (so.empty() && !is_clear)
    return answer(i_do_not_know());
  if (so.empty())
    return answer(with_marker("no", as_it_is(id, pronoun("it"), need(alternatives, "First"))),
                  marker("no"));
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  for (const auto* one : so)
    result.sentences.push_back({ascribe(pronoun("it"), part_of(form_, one->name)), marker("yes")});
  return result;
}

/// "It is blue", in the terms of what was said of it.
LogicalForm Responder::as_it_is(const std::string& id, const LogicalForm& what,
                                const Nominal& scope) const {
  auto kind = kind_of_quality(scope.sort);
  auto words = kind ? scene_.words(id, *kind) : std::vector<std::string>{};
  return ascribe(what, words.empty() || kind == FeatureKind::shape
                         ? indefinite_description(scene_, id)
                         : property(scope.sort, words.front()));
}

} // namespace castor::communication
