#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/components/uses_lexicon.hpp"
#include "castor/communication/dialogue/realiser.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <optional>

namespace castor::communication {

namespace {

/// Puts what is to be said into words.
class SentenceRealiser final : public UsesLexicon<UnmanagedComponent> {
  void configure() override {
    UsesLexicon::configure();
    realiser_.emplace(lexicon());
  }

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
      auto text = realiser_->realise(goal->content);
      if (!text) {
        warning("there are no words for {}", address.id);
        if (!goal->simpler.nominals.empty())
          text = realiser_->realise(goal->simpler);
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

  std::optional<Realiser> realiser_;
};

CASTOR_COMPONENT(SentenceRealiser, "turns logical forms into sentences")

} // namespace

} // namespace castor::communication
