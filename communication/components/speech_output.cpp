#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/registry.hpp"
#include "castor/communication/dialogue/realiser.hpp"
#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/failure.hpp"

#include <cstdio>
#include <string>

namespace castor::communication {

namespace {

/// Puts what is to be said into words, and says it.
class SpeechOutput final : public UnmanagedComponent {
  void start() override {
    on_change(added<ContentPlanningGoal>(),
              [this](const ChangeEvent& event) { put_into_words(event.address); });
    on_change(added<SpokenOutputItem>(), [this](const ChangeEvent& event) { say(event.address); });
  }

  void put_into_words(const Address& address) {
    try {
      auto goal = read<ContentPlanningGoal>(address);
      if (auto text = realiser_.realise(goal->content))
        add(here("words for " + address.id),
            SpokenOutputItem{*text, goal->reply_to, goal->relation});
      else
        warning("there are no words for {}", address.id);
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  void say(const Address& address) {
    try {
      std::printf("%s: %s\n", speaker_->c_str(), read<SpokenOutputItem>(address)->text.c_str());
      std::fflush(stdout);
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  Option<std::string> speaker_{this, "speaker", "robot", "who speaks"};

  Realiser realiser_{english_lexicon()};
};

CASTOR_COMPONENT(SpeechOutput, "puts what is to be said into words and prints it")

} // namespace

} // namespace castor::communication
