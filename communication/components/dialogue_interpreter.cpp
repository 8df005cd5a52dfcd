#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/components/uses_lexicon.hpp"
#include "castor/communication/dialogue/dialogue_move.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <string>
#include <utility>

namespace castor::communication {

namespace {

/// Says what is done by an utterance, and what is wrong with one that is not understood.
class DialogueInterpreter final : public UsesLexicon<UnmanagedComponent> {
  void start() override {
    on_change(changed<PackedLogicalForm>(), [this](const ChangeEvent& event) {
      if (event.operation != Operation::remove)
        look(event.address);
    });
    // What a predecessor did not get to.
    for (auto& x : read_all<PackedLogicalForm>())
      look(x.address);
  }

  void look(const Address& address) {
    try {
      if (auto form = read<PackedLogicalForm>(address); form->state == InterpretationState::pruned)
        interpret(address, *form);
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    } catch (const AlreadyExistsOnWM&) {
      trace("{} was interpreted before", address.id);
    }
  }

  /// The entry is called after the form, so nothing is interpreted twice.
  void interpret(const Address& address, const PackedLogicalForm& form) {
    DialogueMove move;
    move.turn = form.turn;
    move.utterance = form.utterance;
    move.corrections = form.corrections;
    move.partial = form.partial;
    move.mention = form.mention;
    move.sequel = form.sequel;
    if (!is_understood(form))
      move.problem = problem_of(form, lexicon()->meanings());
    else
      take_readings(form, move);
    take_requests(move, lexicon()->meanings());
    add(here("move of " + address.id), std::move(move));
  }
};

CASTOR_COMPONENT(DialogueInterpreter,
                 "classifies dialogue moves: assertions, questions, requests, greetings")

} // namespace

} // namespace castor::communication
