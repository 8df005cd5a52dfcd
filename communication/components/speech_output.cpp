#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/components/program.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <cstdio>
#include <deque>
#include <string>

namespace castor::communication {

namespace {

/// Says the sentences that are to be said, one after the other.
class SpeechOutput final : public UnmanagedComponent {
  void start() override {
    on_change(added<SpokenOutputItem>(),
              [this](const ChangeEvent& event) { to_say_.push_back(event.address); });
  }

  void run() override {
    do
      while (!to_say_.empty()) {
        auto next = to_say_.front();
        to_say_.pop_front();
        say(next);
      }
    while (wait_for_changes() || is_running());
  }

  void say(const Address& address) {
    try {
      auto item = *read<SpokenOutputItem>(address);
      const auto& text = item.text;
      std::printf("%s: %s\n", speaker_->c_str(), text.c_str());
      std::fflush(stdout);
      if (!voice_->empty())
        speak(text);
      item.spoken = true;
      overwrite(address, std::move(item));
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  /// One sentence after the other.
  void speak(const std::string& text) {
    Program voice{voice_.get(), text};
    while (!voice.has_ended() && sleep_for(std::chrono::milliseconds{20}))
      continue;
    if (voice.has_ended() && voice.status() != 0)
      warning("--voice {} ended with status {}; is it installed?", voice_.get(), voice.status());
  }

  Option<std::string> speaker_{this, "speaker", "robot", "who speaks"};
  Option<std::string> voice_{this, "voice", "",
                             "a program that says its last argument aloud, such as espeak-ng"};

  std::deque<Address> to_say_;
};

CASTOR_COMPONENT(SpeechOutput, "prints the robot's sentences, and speaks them")

} // namespace

} // namespace castor::communication
