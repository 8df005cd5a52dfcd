#include "castor/communication/dialogue/responder.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <utility>

namespace castor::communication {

const Nominal& Responder::root() const {
  const auto* result = find_nominal(form_, form_.root);
  if (result == nullptr)
    throw Uninterpretable{Uninterpretable::Reason::word, form_.root};
  return *result;
}

const Nominal& Responder::need(const Nominal& of, const char* mode) const {
  const auto* result = dependent(form_, of, mode);
  if (result == nullptr)
    throw Uninterpretable{Uninterpretable::Reason::word, of.proposition};
  return *result;
}

Response Responder::to_directive() {
  for (const auto* thing : things_spoken_of(form_))
    if (is_definite(*thing))
      evaluation_.meant(*thing);
  return {RhetoricalRelation::answer, {{i_cannot_do_that()}}, {}, {}};
}

/// The phrase as it was said; pronouns are spoken of as things.
LogicalForm Responder::called(const Nominal& phrase) const {
  auto result = part_of(form_, phrase.name);
  if (is_pronoun(phrase))
    result.nominals.front().proposition = "thing";
  return result;
}

LogicalForm Responder::nothing_like(const Nominal& phrase) const {
  return i_do_not_see(called(phrase));
}

Response Responder::to(const Uninterpretable& why) const {
  using Reason = Uninterpretable::Reason;
  const auto* phrase = find_nominal(form_, why.what);
  // "Can you take the ball?"
  if (why.reason == Reason::word && root().sort == "action")
    return {RhetoricalRelation::answer, {{i_cannot_do_that()}}, {}, {}};
  // Where people are, the table does not tell.
  if (why.reason == Reason::word && (why.what == "i" || why.what == "you" || why.what == "we"))
    return {RhetoricalRelation::answer, {{i_do_not_know()}}, {}, {}};
  if (why.reason == Reason::word || phrase == nullptr ||
      (phrase->sort != "thing" && phrase->sort != "person"))
    return {RhetoricalRelation::clarification_question,
            {},
            "I do not know what '" + (phrase == nullptr ? why.what : phrase->proposition) +
              "' means here.",
            {}};
  if (why.reason == Reason::unknown || phrase->sort == "person")
    return {RhetoricalRelation::answer, {{i_do_not_know()}}, {}, {}};
  if (why.reason == Reason::ambiguous && is_deictic(*phrase))
    return {RhetoricalRelation::clarification_question, {}, "What do you point at?", phrase->name};
  // What there are no words for is called by its noun.
  const auto simpler = definite(is_pronoun(*phrase) ? "thing" : phrase->proposition);
  if (why.reason == Reason::nothing_like)
    return {
      RhetoricalRelation::correction, {{nothing_like(*phrase), i_do_not_see(simpler)}}, {}, {}};
  return {RhetoricalRelation::clarification_question,
          {{which(called(*phrase)), which(simpler)}},
          {},
          phrase->name};
}

} // namespace castor::communication
