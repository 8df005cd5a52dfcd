#include "castor/actors/component/registry.hpp"
#include "castor/communication/components/asks_binding.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/dialogue/presence.hpp"
#include "castor/communication/dialogue/question_context.hpp"
#include "castor/communication/dialogue/respond.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <utility>

namespace castor::communication {

namespace {

/// Decides what to say in reply to each dialogue move whose referents are known.
class ContentPlanner final : public AsksBinding<UnmanagedComponent> {
  void start() override {
    on_change(added<MoveReferents>(), [this](const ChangeEvent& event) { look(event.address); });
    for (auto& x : read_all<MoveReferents>())
      look(x.address);
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
    auto meant =
      questions_->complete(with_names_told(move, *words), from_entry(referents.pronouns));
    auto response = with_scene(binding_.get(), [&](SceneKnowledge& scene) {
      return respond(meant.move, meant.antecedents, scene);
    });
    questions_->note(meant, response);
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
  }

  /// Follows from the move, so that no move is replied to twice.
  Address reply_id(const EntryPointer<DialogueMove>& move, std::size_t sentence) const {
    return here("reply to " + move.address.id +
                (sentence == 0 ? std::string{} : ", " + std::to_string(sentence + 1)));
  }

  Option<SubarchitectureName> binding_{this, "binding", "binding", "the binding subarchitecture"};

  std::optional<QuestionContext> questions_;
};

CASTOR_COMPONENT(ContentPlanner, "decides what to say in reply")

} // namespace

} // namespace castor::communication
