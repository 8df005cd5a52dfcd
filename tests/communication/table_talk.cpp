#include "castor/tests/communication/table_talk.hpp"

#include "castor/communication/dialogue/assertion.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/dialogue/pointing.hpp"
#include "castor/communication/dialogue/presence.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/dialogue/sequels.hpp"
#include "castor/communication/dialogue/understanding.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace castor::communication::test {

namespace {

struct Language {
  explicit Language(const std::shared_ptr<const Lexicon>& lexicon)
    : parser(lexicon), realiser(lexicon) {}

  Parser parser;
  Realiser realiser;
};

/// Made once for each lexicon: that takes some time.
Language& language_of(const std::shared_ptr<const Lexicon>& lexicon) {
  static std::map<std::shared_ptr<const Lexicon>, std::unique_ptr<Language>> all;
  auto& result = all[lexicon];
  if (!result)
    result = std::make_unique<Language>(lexicon);
  return *result;
}

} // namespace

Reply TableTalk::say(const std::string& text) {
  Reply reply;
  auto sentences = sentences_of(text);
  // "?!" is no sentence, but it is said.
  if (sentences.empty())
    sentences.push_back(text);
  for (auto& sentence : sentences) {
    const auto silences = reply.silences;
    reply = say_all(sentence);
    reply.silences += silences;
  }
  return reply;
}

Reply TableTalk::say_all(const std::string& text) {
  auto reply = say_sentence(text);
  if (reply.sequel.empty())
    return reply;
  auto next = say_all(reply.sequel);
  reply.steps.insert(reply.steps.end(), next.steps.begin(), next.steps.end());
  next.steps = std::move(reply.steps);
  next.text = reply.text + (reply.text.empty() || next.text.empty() ? "" : " ") + next.text;
  next.silences += reply.silences;
  next.is_parsed = next.is_parsed && reply.is_parsed;
  return next;
}

void TableTalk::point(const Pointing& pointing) {
  pointing_ = pointing;
  ++gestures_;
}

Reply TableTalk::say_sentence(const std::string& text) {
  auto& language = language_of(vocabulary_->lexicon());
  auto& parser = language.parser;
  auto& realiser = language.realiser;
  auto form = understood(parser, words_of(text));
  DialogueMove move;
  move.corrections = form.corrections;
  move.partial = form.partial;
  move.mention = form.mention;
  move.sequel = form.sequel;
  form.text = text;
  move.turn = static_cast<std::int32_t>(history_.size());
  Reply reply;
  if (!is_understood(form)) {
    reply.is_parsed = false;
    move.problem = problem_of(form, vocabulary_->meanings());
  } else
    take_readings(form, move);
  take_requests(move, vocabulary_->meanings());
  auto antecedents = antecedents_in(move, history_, *vocabulary_);
  move = with_names_told(std::move(move), *vocabulary_);
  antecedents.merge(with_knowledge(vocabulary_, binding_, [&](SceneKnowledge& scene) {
    return antecedents_by_presence(move, scene);
  }));
  MoveReferents referents;
  if (pointing_) {
    referents.pointing = PointingUse{{{"communication", "pointing"}}, gestures_, false};
    if (!is_stale(*pointing_, *referents.pointing, history_, {}, {})) {
      auto shown = with_knowledge(vocabulary_, binding_, [&](SceneKnowledge& scene) {
        return antecedents_by_pointing(move, {pointing_->x, pointing_->y}, antecedents, scene,
                                       PointingLimits{}.reach);
      });
      referents.pointing->taken_up = !shown.empty();
      antecedents.merge(shown);
    }
  }
  auto meant = questions_.complete(move, antecedents);
  auto response = with_knowledge(vocabulary_, binding_, [&](SceneKnowledge& scene) {
    return respond(meant.move, meant.antecedents, scene);
  });
  questions_.note(meant, response);
  const auto next = continued(move, response, last_answer_);
  if (const auto truth = truth_said(response))
    last_answer_ = truth;
  response = next.response;
  reply.sequel = next.sequel;
  referents.turn = move.turn;
  referents.understood = move.problem.empty();
  referents.referents = with_knowledge(vocabulary_, binding_, [&](SceneKnowledge& scene) {
    return referents_of(reading_of(meant.move, response.reading), meant.antecedents, scene);
  });
  referents.pronouns = to_entry(meant.antecedents);
  if (meant.move.type == DialogueMoveType::assertion)
    tell_of(meant.move, referents);
  if (!meant.move.partial)
    reply.steps = with_knowledge(vocabulary_, binding_, [&](SceneKnowledge& scene) {
      return steps_asked_for(reading_of(meant.move, response.reading), meant.antecedents, scene);
    });
  referents.is_unclear = reply.steps.empty() && meant.move.problem.empty() &&
                         asks_to_act(meant.move) &&
                         is_handling(meant.move.content, vocabulary_->meanings());
  history_.push_back(std::move(referents));
  reply.corrects = is_correction(meant.move.content);
  reply.comes_first = is_to_be_first(meant.move.content);
  reply.asks_whether_possible = asks_for_ability(meant.move.content);
  reply.move = meant.move.type;
  reply.relation = response.relation;
  reply.text = said_back(move);
  if (!response.text.empty())
    reply.text += (reply.text.empty() ? "" : " ") + response.text;
  for (auto& sentence : response.sentences) {
    auto spoken = realiser.realise(sentence.content);
    if (!spoken && !sentence.simpler.nominals.empty())
      spoken = realiser.realise(sentence.simpler);
    reply.silences += spoken ? 0 : 1;
    reply.text += (reply.text.empty() ? "" : " ") + spoken.value_or("<no words>");
  }
  return reply;
}

void TableTalk::tell_of(const DialogueMove& move, const MoveReferents& referents) {
  if (!tell_)
    return;
  auto told = with_knowledge(
    vocabulary_, binding_, [&](SceneKnowledge& scene) { return told_by(move, referents, scene); });
  for (auto& features : told.proxies)
    tell_("said " + std::to_string(told_++), std::move(features));
}

} // namespace castor::communication::test
