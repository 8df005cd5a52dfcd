#include "castor/communication/dialogue/responder.hpp"

#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/dialogue/pointing.hpp"
#include "castor/communication/dialogue/referring_expression.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// Parts of what was said are repeated under their names, or these with a prefix.
bool repeats(const Nominal& x, const Nominal& said) {
  return x.sort == said.sort && x.proposition == said.proposition &&
         (x.name == said.name || x.name.ends_with('-' + said.name));
}

/// "Do not put anything on the left", "keep clear of the edge": about a part of the table.
bool forbids_place(const LogicalForm& form, const Nominal& request) {
  const auto* patient = dependent(form, request, "Patient");
  if (request.sort != "action" || patient == nullptr)
    return false;
  const bool is_forbidden = forbids(request);
  if (patient->sort == "place")
    return is_forbidden;
  const auto* destination = dependent(form, request, "Destination");
  const auto* anchor = destination == nullptr ? nullptr : dependent(form, *destination, "Anchor");
  const auto all = feature(*patient, "Delimitation");
  return destination != nullptr && (anchor == nullptr || anchor->sort == "place") &&
         ((is_forbidden && all == "any") || all == "none");
}

} // namespace

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
  if (is_handling(form_, vocabulary().meanings())) {
    steps_of(form_, antecedents_, scene_);
    return cannot_do_that();
  }
  for (const auto* thing : things_spoken_of(form_, vocabulary()))
    if (is_definite(*thing))
      evaluation_.meant(*thing);
  return cannot_do_that();
}

/// And what it can do instead, where the lexicon says that.
Response Responder::cannot_do_that() const {
  const auto& replies = vocabulary().meanings().replies;
  if (const auto deeds = replies.find("deeds"); deeds != replies.end())
    return {RhetoricalRelation::answer, {}, "I can not do that. " + deeds->second, {}};
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

Response Responder::described(Response response) {
  for (auto& sentence : response.sentences) {
    sentence.content = described(std::move(sentence.content));
    sentence.simpler = described(std::move(sentence.simpler));
  }
  return response;
}

LogicalForm Responder::described(LogicalForm said) {
  std::vector<Nominal> descriptions;
  for (auto& x : said.nominals)
    for (auto& phrase : form_.nominals) {
      if (!is_shown(form_, phrase, vocabulary()) || !repeats(x, phrase))
        continue;
      const auto things = evaluation_.meant(phrase);
      if (things.size() != 1)
        continue;
      const auto description = referring_expression(scene_, things.front());
      const auto prefix = x.name + "-shown-";
      for (auto part : description.nominals) {
        for (auto& relation : part.relations)
          relation.dependent = prefix + relation.dependent;
        const bool is_root = part.name == description.root;
        part.name = is_root ? x.name : prefix + part.name;
        if (is_root)
          x = std::move(part);
        else
          descriptions.push_back(std::move(part));
      }
      break;
    }
  if (said.nominals.empty())
    return said;
  said.nominals.insert(said.nominals.end(), descriptions.begin(), descriptions.end());
  return part_of(said, said.root);
}

/// "Take the orange cube": which cubes there are, so that another can be named. Empty if it was not
/// asked for by more than a noun, or there is none.
std::vector<Sentence> Responder::others_of_noun(const Nominal& phrase) {
  if (root().sort != "action" || phrase.relations.empty() || is_plural(phrase) ||
      vocabulary().is_general(phrase.proposition) || is_pronoun(phrase))
    return {};
  auto form = definite(phrase.proposition);
  const auto things =
    Evaluation{form, {}, scene_}.described(*find_nominal(form, form.root)).certain;
  if (things.empty() || !scene_.open_questions().empty())
    return {};
  return list(things).sentences;
}

Response Responder::to(const Uninterpretable& why) {
  using Reason = Uninterpretable::Reason;
  const auto* phrase = find_nominal(form_, why.what);
  // "Can you throw the ball?", whichever it is.
  if (why.reason == Reason::ambiguous && root().sort == "action" &&
      !is_handling(form_, vocabulary().meanings()) &&
      vocabulary().meanings().replies.contains("deeds"))
    return cannot_do_that();
  // "If the ball is on the left, take it."
  if (why.reason == Reason::not_so)
    return {RhetoricalRelation::answer, {}, "That is not so, so I do nothing.", {}};
  // "Do not put anything on the left side."
  if (why.reason == Reason::word && forbids_place(form_, root()))
    return {RhetoricalRelation::clarification_question,
            {},
            "I cannot keep a part of the table free from now on. I can clear it now, and leave "
            "things alone that you name.",
            {}};
  // "Can you take the ball?"
  if (why.reason == Reason::word && root().sort == "action")
    return cannot_do_that();
  // What belongs to whom, and who likes what, the table does not tell; nor where people are.
  if (why.reason == Reason::word && root().sort == "perception")
    return {RhetoricalRelation::answer, {{i_do_not_know()}}, {}, {}};
  if (why.reason == Reason::word && (why.what == "i" || why.what == "you" || why.what == "we"))
    return {RhetoricalRelation::answer, {{i_do_not_know()}}, {}, {}};
  // "Get a biscuit from the kitchen."
  if (why.reason == Reason::unknown && root().sort == "action" && feature(root(), "Mood") == "imp")
    return cannot_do_that();
  if (why.reason == Reason::unknown)
    return {RhetoricalRelation::answer, {{i_do_not_know()}}, {}, {}};
  if (why.reason == Reason::word || phrase == nullptr ||
      (phrase->sort != "thing" && phrase->sort != "person"))
    return {RhetoricalRelation::clarification_question,
            {},
            "I do not know what '" + (phrase == nullptr ? why.what : phrase->proposition) +
              "' means here.",
            {}};
  if (phrase->sort == "person")
    return {RhetoricalRelation::answer, {{i_do_not_know()}}, {}, {}};
  if (why.reason == Reason::unknown_kind)
    return {RhetoricalRelation::answer,
            {{i_know_nothing_of(vocabulary().kind_noun(phrase->proposition)), i_do_not_know()}},
            {},
            {}};
  if (why.reason == Reason::nothing_pointed_at)
    return {RhetoricalRelation::correction, {}, "I do not see what you point at.", {}};
  // What there are no words for is called by its noun.
  const auto simpler = definite(is_pronoun(*phrase) ? "thing" : phrase->proposition);
  if (why.reason == Reason::nothing_like) {
    std::vector<Sentence> sentences{{nothing_like(*phrase), i_do_not_see(simpler)}};
    std::ranges::move(others_of_noun(*phrase), std::back_inserter(sentences));
    return {RhetoricalRelation::correction, std::move(sentences), {}, {}};
  }
  return {RhetoricalRelation::clarification_question,
          {{which(called(*phrase)), which(simpler)}},
          {},
          phrase->name};
}

} // namespace castor::communication
