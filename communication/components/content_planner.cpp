#include "castor/actors/component/registry.hpp"
#include "castor/communication/components/asks_binding.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/directive.hpp"
#include "castor/communication/dialogue/presence.hpp"
#include "castor/communication/dialogue/proposals.hpp"
#include "castor/communication/dialogue/question_context.hpp"
#include "castor/communication/dialogue/respond.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/dialogue/sequels.hpp"
#include "castor/communication/dialogue/small_talk.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/planning/tabletop/types.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

namespace {

/// Decides what to say in reply to each dialogue move whose referents are known.
class ContentPlanner final : public AsksBinding<UnmanagedComponent> {
  void start() override {
    on_change(added<MoveReferents>(), [this](const ChangeEvent& event) { look(event.address); });
    if (motivation_->empty())
      return;
    on_change(added<planning::MotiveAcknowledgement>().in(motivation_),
              [this](const ChangeEvent& event) { tell(event.address); });
    on_change(added<planning::RequestEnded>().in(motivation_),
              [this](const ChangeEvent& event) { say_sequel_after(event.address); });
  }

  void run() override {
    // What a predecessor did not get to. Binding, which is asked, may be started after this.
    for (auto& x : read_all<MoveReferents>())
      look(x.address);
    if (motivation_->empty())
      return;
    for (auto& x : read_all_in<planning::MotiveAcknowledgement>(motivation_))
      tell(x.address);
    for (auto& x : read_all_in<planning::RequestEnded>(motivation_))
      say_sequel_after(x.address);
  }

  /// What becomes of a request, as who decides on that says.
  void tell(const Address& address) {
    try {
      const auto told = read<planning::MotiveAcknowledgement>(address);
      if (!told->cause.points_to<DialogueMove>())
        return;
      const auto move = told->cause.as<DialogueMove>();
      const bool is_possible = told->reply == planning::MotiveReply::done;
      const bool is_answer = moves_asked_whether_.contains(move.address.id);
      if (is_answer)
        last_answer_ = is_possible;
      const auto relation = told->reply == planning::MotiveReply::accepted
                              ? RhetoricalRelation::acceptance
                              : RhetoricalRelation::answer;
      add(here("words of " + address.id),
          SpokenOutputItem{told->words, move, follow(move)->utterance, relation});
      const auto sequel = is_answer ? follow(move)->sequel : std::nullopt;
      if (sequel && sequel->is_conditional)
        say(move, is_possible ? sequel->words : sequel->otherwise);
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    } catch (const AlreadyExistsOnWM& e) {
      debug("{}", e.what());
    }
  }

  /// What waits for a request is said as if it were heard now. When that has failed, only a
  /// question is, or what was said for that case.
  void say_sequel_after(const Address& address) {
    try {
      const auto ended = read<planning::RequestEnded>(address);
      const auto clarified = sequels_.find(ended->move.address.id);
      const auto sequel =
        clarified == sequels_.end() ? follow(ended->move)->sequel : clarified->second;
      if (!sequel)
        return;
      const bool is_said = ended->is_done || (sequel->is_question && !sequel->is_conditional);
      const auto& next = is_said                  ? sequel->words
                         : sequel->is_conditional ? sequel->otherwise
                                                  : std::string{};
      say(ended->move, next);
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  /// Once for each move; nothing if there are no words.
  void say(const EntryPointer<DialogueMove>& after, const std::string& words) {
    if (words.empty())
      return;
    PhonString utterance;
    utterance.word_sequence = words;
    utterance.length = static_cast<std::int32_t>(words_of(words).size());
    utterance.turn = static_cast<std::int32_t>(read_all<PhonString>().size());
    try {
      add(here("utterance after " + after.address.id), std::move(utterance));
    } catch (const AlreadyExistsOnWM& e) {
      debug("{}", e.what());
    }
  }

  void look(const Address& address) {
    try {
      auto referents = read<MoveReferents>(address);
      if (!exists(reply_id(referents->move, 0)))
        reply(*referents, *follow(referents->move));
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    } catch (const AlreadyExistsOnWM& e) {
      debug("{}", e.what());
    }
  }

  /// All sentences at once, so nothing is said twice.
  void reply(const MoveReferents& referents, const DialogueMove& move) {
    const auto& words = vocabulary(binding_.get());
    if (!questions_)
      questions_.emplace(words);
    questions_->set_vocabulary(words);
    questions_->rename(renamed_things(table_.get(), binding_.get()));
    auto meant =
      questions_->complete(with_names_told(move, *words), from_entry(referents.pronouns));
    auto response = with_scene(binding_.get(), [&](SceneKnowledge& scene) {
      return respond(meant.move, meant.antecedents, scene);
    });
    if (const auto text = about_name(reading_of(meant.move, response.reading)))
      response = {RhetoricalRelation::acceptance, {}, *text, {}};
    questions_->note(meant, response);
    if (response.proposes)
      response.text = proposed_by(meant, response);
    // What is not clear is asked back, and not asked of who does it.
    if (const auto text = referents.is_unclear ? std::nullopt : about_motives(move, referents))
      response = {RhetoricalRelation::answer, {}, *text, {}};
    if (referents.asks_whether_possible)
      moves_asked_whether_.insert(referents.move.address.id);
    const bool waits = !referents.steps.empty() && !referents.asks_whether_possible;
    const auto truth = truth_said(response);
    auto next = continued(meant.move, std::move(response), last_answer_);
    response = std::move(next.response);
    last_answer_ = truth ? truth : last_answer_;
    if (waits && meant.move.sequel)
      sequels_.emplace(referents.move.address.id, *meant.move.sequel);
    WriteBatch batch;
    for (auto& text : {said_back(move), response.text})
      if (!text.empty())
        batch.add(reply_id(referents.move, batch.items().size()),
                  SpokenOutputItem{text, referents.move, move.utterance, response.relation});
    for (auto& [content, simpler] : response.sentences)
      batch.add(
        reply_id(referents.move, batch.items().size()),
        ContentPlanningGoal{content, simpler, referents.move, move.utterance, response.relation});
    write(batch);
    if (!next.sequel.empty() && !waits && !referents.is_unclear)
      say(referents.move, next.sequel);
  }

  /// Asks in the words of whoever would do it, or says why that is impossible. As the response says
  /// if nobody knows of the things.
  std::string proposed_by(const CompleteMove& meant, const Response& response) {
    if (table_->empty())
      return response.text;
    const auto steps = with_scene(binding_.get(), [&](SceneKnowledge& scene) {
      return steps_asked_for(reading_of(meant.move, response.reading), meant.antecedents, scene);
    });
    std::vector<std::string> deeds;
    for (const auto& step : steps)
      try {
        auto told = call<planning::TableGoalRequest, planning::TableGoalReply>(
          table_, {step, false}, {.timeout = std::chrono::seconds{3}});
        // Of later steps nobody knows yet.
        if (told.is_impossible && deeds.empty())
          return told.refusal;
        if (told.words.empty())
          return response.text;
        deeds.push_back(std::move(told.words));
      } catch (const WorkingMemoryException& e) {
        warning("{} does not say what a request comes to: {}", table_.get(), e.what());
        return response.text;
      }
    return deeds.empty() ? response.text : proposal_of(deeds);
  }

  /// What the robot does and why, and nothing for a request, which is replied to by `tell`. None if
  /// the move is about something else, or nobody answers.
  std::optional<std::string> about_motives(const DialogueMove& move,
                                           const MoveReferents& referents) {
    if (motivation_->empty() || !move.problem.empty())
      return std::nullopt;
    if (move.type == DialogueMoveType::action_directive || !referents.steps.empty())
      return std::string{};
    using Kind = planning::MotiveQuestionKind;
    static const std::map<std::string, Kind, std::less<>> kinds{
      {"doing", Kind::doing},     {"next", Kind::next}, {"why", Kind::why},
      {"why-not", Kind::why_not}, {"done", Kind::done}, {"whether", Kind::whether}};
    const auto kind = kinds.find(small_talk_topic(move.content));
    if (move.type != DialogueMoveType::small_talk || kind == kinds.end() ||
        asks_about_no_thing(move.content))
      return std::nullopt;
    const auto about = things_asked_about(move.content, *vocabulary(binding_.get()));
    try {
      return call<planning::MotiveQuestion, planning::MotiveAnswer>(
               motivation_, {kind->second, about}, {.timeout = std::chrono::seconds{3}})
        .words;
    } catch (const WorkingMemoryException& e) {
      warning("motivation does not answer: {}", e.what());
      return std::nullopt;
    }
  }

  /// What who takes note of names says of one. None if the move tells of no such name, or nobody
  /// answers.
  std::optional<std::string> about_name(const DialogueMove& move) {
    if (move.type != DialogueMoveType::assertion || !move.problem.empty())
      return std::nullopt;
    const auto told = with_scene(
      binding_.get(), [&](SceneKnowledge& scene) { return name_told(move.content, scene); });
    if (!told)
      return std::nullopt;
    try {
      return call<binding::ToldName, binding::ToldNameReply>(told->subarchitecture, {told->name},
                                                             {.timeout = std::chrono::seconds{3}})
        .words;
    } catch (const WorkingMemoryException& e) {
      warning("{} does not take note of the name {}: {}", told->subarchitecture, told->name,
              e.what());
      return std::nullopt;
    }
  }

  /// Follows from the move, so that no move is replied to twice.
  Address reply_id(const EntryPointer<DialogueMove>& move, std::size_t sentence) const {
    return here("reply to " + move.address.id +
                (sentence == 0 ? std::string{} : ", " + std::to_string(sentence + 1)));
  }

  Option<SubarchitectureName> binding_{this, "binding", "binding", "the binding subarchitecture"};
  Option<SubarchitectureName> motivation_{this, "motivation", "",
                                          "the subarchitecture of motives; empty if there is none"};

  Option<SubarchitectureName> table_{
    this, "table", "", "the subarchitecture that knows what was moved; empty if there is none"};

  std::optional<QuestionContext> questions_;
  /// Whether the last question was answered by yes.
  std::optional<bool> last_answer_;
  /// Moves by which it is only asked whether something can be done.
  std::set<std::string, std::less<>> moves_asked_whether_;
  /// What waits for requests that were clarified, by their moves.
  std::map<std::string, Sequel, std::less<>> sequels_;
};

CASTOR_COMPONENT(ContentPlanner, "decides what to say in reply")

} // namespace

} // namespace castor::communication
