#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/dialogue/dialogue_structure.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace castor::communication {

namespace {

/// Keeps the one entry that says who said what, and in reply to what.
class DialogueHistorian final : public UnmanagedComponent {
  void start() override {
    on_change(added<DialogueMove>(), [this](const ChangeEvent& event) { hear(event.address); });
    on_change(added<SpokenOutputItem>(),
              [this](const ChangeEvent& event) { speak(event.address); });
    try {
      dialogue_ = *read<DialogueStructure>(address());
    } catch (const DoesNotExistOnWM&) {
      add(address(), dialogue_);
    }
    for (auto& x : read_all<DialogueMove>())
      hear(x.address);
    for (auto& x : read_all<SpokenOutputItem>())
      speak(x.address);
  }

  Address address() const { return here("dialogue"); }

  void hear(const Address& move) {
    try {
      DialogueTurn turn;
      turn.speaker = "human";
      turn.contribution = EntryPointer<DialogueMove>{move};
      turn.type = read<DialogueMove>(move)->type;
      write_down(connected(std::move(turn), dialogue_.turns));
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  void speak(const Address& item) {
    try {
      auto said = read<SpokenOutputItem>(item);
      DialogueTurn turn;
      turn.speaker = "robot";
      turn.contribution = EntryPointer<SpokenOutputItem>{item};
      turn.relation = said->relation;
      if (said->reply_to)
        turn.to = said->reply_to;
      write_down(std::move(turn));
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  void write_down(DialogueTurn turn) {
    if (std::ranges::find(dialogue_.turns, turn.contribution, &DialogueTurn::contribution) !=
        dialogue_.turns.end())
      return;
    dialogue_.turns.push_back(std::move(turn));
    if (dialogue_.turns.size() > remembered_)
      dialogue_.turns.erase(dialogue_.turns.begin());
    put(address(), dialogue_);
  }

  Option<std::uint32_t> remembered_{this, "remembered", 200, "how many turns are kept"};

  DialogueStructure dialogue_;
};

CASTOR_COMPONENT(DialogueHistorian, "records who said what, and in reply to what")

} // namespace

} // namespace castor::communication
