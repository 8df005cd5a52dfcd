#include "castor/actors/component/registry.hpp"
#include "castor/communication/components/asks_binding.hpp"
#include "castor/communication/dialogue/response.hpp"
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
    auto antecedents = pronouns_of(referents);
    auto meant = move;
    if (unclear_ && move.type == DialogueMoveType::none && move.problem.empty()) {
      meant = clarified(unclear_->move, unclear_->nominal, move.content);
      antecedents.insert(unclear_->antecedents.begin(), unclear_->antecedents.end());
    }
    auto response = with_scene(
      binding_.get(), [&](SceneKnowledge& scene) { return respond(meant, antecedents, scene); });
    unclear_.reset();
    if (!response.asked_about.empty())
      unclear_ = Unclear{std::move(meant), response.asked_about, std::move(antecedents)};
    WriteBatch batch;
    for (auto& content : response.contents)
      batch.add(reply_id(referents.move, batch.items().size()),
                ContentPlanningGoal{content, referents.move, move.utterance, response.relation});
    if (!response.text.empty())
      batch.add(reply_id(referents.move, batch.items().size()),
                SpokenOutputItem{response.text, referents.move, move.utterance, response.relation});
    if (!batch.items().empty())
      write(batch);
  }

  /// Follows from the move, so that no move is replied to twice.
  Address reply_id(const EntryPointer<DialogueMove>& move, std::size_t sentence) const {
    return here("reply to " + move.address.id +
                (sentence == 0 ? std::string{} : ", " + std::to_string(sentence + 1)));
  }

  /// What was found for "it" and the like.
  static Antecedents pronouns_of(const MoveReferents& referents) {
    Antecedents result;
    for (auto& x : referents.referents)
      if (x.proxies.size() == 1 && is_pronoun({x.nominal, "thing", x.proposition, {}, {}}))
        result.emplace(x.nominal, x.proxies.front());
    return result;
  }

  /// What the other was asked back about.
  struct Unclear {
    DialogueMove move;
    std::string nominal;
    Antecedents antecedents;
  };

  Option<SubarchitectureName> binding_{this, "binding", "binding", "the binding subarchitecture"};

  std::optional<Unclear> unclear_;
};

CASTOR_COMPONENT(ContentPlanner, "decides what to say in reply")

} // namespace

} // namespace castor::communication
