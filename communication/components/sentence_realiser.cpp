#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/dialogue/realiser.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/entries/failure.hpp"

namespace castor::communication {

namespace {

/// Puts what is to be said into words.
class SentenceRealiser final : public UnmanagedComponent {
  void start() override {
    on_change(added<ContentPlanningGoal>(),
              [this](const ChangeEvent& event) { realise(event.address); });
    // What a predecessor did not get to.
    for (auto& x : read_all<ContentPlanningGoal>())
      realise(x.address);
  }

  /// The entry is called after the goal, so nothing is said twice.
  void realise(const Address& address) {
    try {
      auto goal = read<ContentPlanningGoal>(address);
      auto text = realiser_.realise(goal->content);
      if (!text) {
        warning("there are no words for {}", address.id);
        if (!goal->simpler.nominals.empty())
          text = realiser_.realise(goal->simpler);
      }
      add(here(spoken_id(address)),
          SpokenOutputItem{text.value_or("I have no words for my answer."), goal->reply_to,
                           goal->utterance, goal->relation});
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    } catch (const AlreadyExistsOnWM&) {
      trace("{} was put into words before", address.id);
    }
  }

  Realiser realiser_{english_lexicon()};
};

CASTOR_COMPONENT(SentenceRealiser, "turns logical forms into sentences")

} // namespace

} // namespace castor::communication
