#include "castor/communication/dialogue/respond.hpp"

#include "castor/communication/dialogue/clause_parts.hpp"
#include "castor/communication/dialogue/content.hpp"
#include "castor/communication/dialogue/descriptions.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/fragments.hpp"
#include "castor/communication/dialogue/proposals.hpp"
#include "castor/communication/dialogue/responder.hpp"
#include "castor/communication/dialogue/small_talk.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

Response say(RhetoricalRelation relation, LogicalForm content) {
  return {relation, {{std::move(content)}}, {}, {}};
}

Response say(RhetoricalRelation relation, std::string text) {
  return {relation, {}, std::move(text), {}};
}

/// \throws Uninterpretable
Response respond(Responder& responder, DialogueMoveType type, const LogicalForm& content,
                 const WordMeanings& meanings) {
  if (type == DialogueMoveType::question_w || type == DialogueMoveType::question_yn ||
      type == DialogueMoveType::assertion)
    responder.check_presuppositions();
  if (auto correction = responder.to_preface())
    return *correction;
  // "Which are?", and nothing before it that could be meant.
  if (is_elliptical(content) || asks_for_more(content))
    return say(RhetoricalRelation::clarification_question, "I do not know what that is about.");
  switch (type) {
    case DialogueMoveType::question_w:
      return responder.to_question_w();
    case DialogueMoveType::question_yn:
      if (asks_for_ability(content) && is_handling(content, meanings))
        return responder.to_directive();
      return responder.to_question_yn();
    case DialogueMoveType::assertion:
      return responder.to_assertion();
    case DialogueMoveType::action_directive:
      return responder.to_directive();
    case DialogueMoveType::opening:
      return say(RhetoricalRelation::greeting, greeting("hello"));
    case DialogueMoveType::closing:
      return say(RhetoricalRelation::greeting, closing("bye"));
    case DialogueMoveType::small_talk:
      return say(RhetoricalRelation::answer, small_talk(content, meanings));
    case DialogueMoveType::reject:
      if (is_refusal_of_proposal(content))
        return say(RhetoricalRelation::clarification_question, "What shall I do then?");
      return say(RhetoricalRelation::acceptance, marker("ok"));
    case DialogueMoveType::accept:
      return say(RhetoricalRelation::acceptance, marker("ok"));
    case DialogueMoveType::none:
      break;
  }
  return say(RhetoricalRelation::clarification_question, "What about it?");
}

/// Each of several questions is replied to.
/// \throws Uninterpretable
Response respond_to_all(Responder& responder, DialogueMoveType type, const LogicalForm& content,
                        const Antecedents& antecedents, SceneKnowledge& scene) {
  const auto questions = questions_in(content);
  if (questions.empty())
    return respond(responder, type, content, scene.vocabulary().meanings());
  Response result{RhetoricalRelation::answer, {}, {}, {}};
  for (auto& question : questions) {
    Responder one{question, antecedents, scene};
    auto reply =
      respond(one, dialogue_move_type(question), question, scene.vocabulary().meanings());
    if (reply.sentences.empty())
      return reply;
    for (auto& sentence : reply.sentences)
      result.sentences.push_back(std::move(sentence));
  }
  return result;
}

const LogicalForm& content_of(const DialogueMove& move, std::size_t reading) {
  return reading == 0 ? move.content : move.alternatives[reading - 1];
}

/// The request, or the first of several; null if the form is none.
const Nominal* first_action(const LogicalForm& form) {
  const auto* x = find_nominal(form, form.root);
  while (x != nullptr && x->sort == "conjunction")
    x = dependent(form, *x, "First");
  return x != nullptr && x->sort == "action" ? x : nullptr;
}

/// What is to be moved: null if the form asks for nothing like that.
const Nominal* moved_thing(const LogicalForm& form) {
  const auto* action = first_action(form);
  const bool is_moved = action != nullptr && dependent(form, *action, "Destination") != nullptr;
  return is_moved ? dependent(form, *action, "Patient") : nullptr;
}

/// Whether a phrase, perhaps with where the things are, means one thing, or several as it says.
bool is_clear(const LogicalForm& form, const Nominal& phrase, const Antecedents& antecedents,
              SceneKnowledge& scene) {
  try {
    const auto meant = Evaluation{form, antecedents, scene}.meant(phrase);
    return is_plural(phrase) ? !meant.empty() : meant.size() == 1;
  } catch (const Uninterpretable&) {
    return false;
  }
}

/// "On the left on the right": of both, one says where it is.
bool has_opposite_places(const LogicalForm& form) {
  const auto is_named = [&](std::string_view place) {
    return std::ranges::any_of(form.nominals, [&](const Nominal& x) {
      return x.sort == "region" && x.proposition == place;
    });
  };
  return (is_named("left") && is_named("right")) || (is_named("front") && is_named("back"));
}

/// "Put the blue ball at the front in the middle": where there is one blue ball, nobody says
/// besides where it is, so that both say where it is to go. "Take the ball on the left" says which
/// one, if one is there.
std::vector<std::size_t> readings_by_likelihood(const DialogueMove& move,
                                                const Antecedents& antecedents,
                                                SceneKnowledge& scene) {
  std::vector<std::size_t> result(move.alternatives.size() + 1);
  std::iota(result.begin(), result.end(), 0);
  const auto* thing = moved_thing(move.content);
  if (thing == nullptr || !is_definite(*thing))
    return result;
  // "The two cubes at the front" may be those that are there.
  if (is_plural(*thing) && is_clear(move.content, *thing, antecedents, scene))
    return result;
  const bool says_where_it_is = dependent(move.content, *thing, "Location") != nullptr;
  // "Take the blue ball to the left", where there is one blue ball.
  const auto& to = *dependent(move.content, *first_action(move.content), "Destination");
  if (!says_where_it_is && !feature(to, "Of").empty() &&
      is_clear(move.content, *thing, antecedents, scene))
    return result;
  const auto is_likelier = [&](std::size_t reading) {
    const auto& content = content_of(move, reading);
    const auto* action = first_action(content);
    const auto* other = says_where_it_is ? moved_thing(content)
                        : action != nullptr && action->proposition == "take"
                          ? dependent(content, *action, "Patient")
                          : nullptr;
    return other != nullptr && other->proposition == thing->proposition &&
           (dependent(content, *other, "Location") == nullptr) == says_where_it_is &&
           !(says_where_it_is && has_opposite_places(content)) &&
           is_clear(content, *other, antecedents, scene);
  };
  if (const auto found = std::ranges::find_if(result, is_likelier); found != result.end())
    std::rotate(result.begin(), found, std::next(found));
  return result;
}

} // namespace

Response respond(const DialogueMove& move, const Antecedents& antecedents, SceneKnowledge& scene) {
  if (!move.problem.empty())
    return say(RhetoricalRelation::clarification_question, move.problem);
  std::optional<Response> refusal;
  bool is_other_request_sought = false;
  for (const auto reading : readings_by_likelihood(move, antecedents, scene)) {
    const auto& content = content_of(move, reading);
    Responder responder{content, antecedents, scene};
    const auto type = reading == 0 ? move.type : dialogue_move_type(content);
    const bool is_request = type == DialogueMoveType::action_directive &&
                            is_handling(content, scene.vocabulary().meanings());
    if (is_other_request_sought && !is_request)
      continue;
    try {
      auto result =
        responder.described(respond_to_all(responder, type, content, antecedents, scene));
      if (move.partial && type == DialogueMoveType::action_directive)
        result = proposal(*move.partial, content);
      result.reading = reading;
      return result;
    } catch (const Uninterpretable& why) {
      auto result = responder.to(why);
      result.reading = reading;
      // "Put the cube on the left next to the ball": perhaps there is no cube on the left.
      const bool may_be_misread = why.reason == Uninterpretable::Reason::nothing_like && is_request;
      if (!may_be_misread && !refusal && why.reason != Uninterpretable::Reason::word)
        return result;
      is_other_request_sought = is_other_request_sought || (may_be_misread && !refusal);
      if (!refusal)
        refusal = std::move(result);
    }
  }
  return *refusal;
}

DialogueMove reading_of(DialogueMove move, std::size_t reading) {
  if (reading > 0 && reading <= move.alternatives.size()) {
    move.content = move.alternatives[reading - 1];
    move.type = dialogue_move_type(move.content);
  }
  move.alternatives.clear();
  return move;
}

} // namespace castor::communication
