#pragma once

#include "castor/actors/component/managed_component.hpp"
#include "castor/communication/types.hpp"
#include "castor/planning/motivation/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

namespace castor::planning {

/// A component that hears what people say, each utterance once, also if it is started again.
class HearsRequests : public ManagedComponent {
protected:
  /// To be called in `start()`: what comes, and what a predecessor did not get to.
  void follow_requests() {
    on_change(added<communication::MoveReferents>().in(communication_),
              [this](const ChangeEvent& event) { arrived(event.address); });
    try {
      heard_ = read<RequestsHeard>(heard_address())->turn;
    } catch (const DoesNotExistOnWM&) {
      add(heard_address(), RequestsHeard{});
    }
    auto all = read_all_in<communication::MoveReferents>(communication_);
    std::ranges::sort(all, {}, [](const auto& x) { return x->turn; });
    for (const auto& x : all)
      arrived(x.address);
  }

  /// Referents of a move are there: to be heard at once or later.
  virtual void arrived(const Address& referents) { hear(referents); }

  /// Calls `heard` if it is new and clear what is meant.
  void hear(const Address& address) {
    try {
      const auto referents = read<communication::MoveReferents>(address);
      if (referents->turn <= heard_)
        return;
      const auto move = follow(referents->move);
      if (move->problem.empty() && !referents->is_unclear)
        heard(*referents, *move);
      heard_ = referents->turn;
      put(heard_address(), RequestsHeard{heard_});
    } catch (const DoesNotExistOnWM& e) {
      debug("{}", e.what());
    }
  }

  virtual void heard(const communication::MoveReferents& referents,
                     const communication::DialogueMove& move) = 0;

  /// The sentence, without the sign at its end.
  std::string words_of(const communication::DialogueMove& move) {
    return words_of(*follow(move.utterance));
  }

  static std::string words_of(const communication::PhonString& utterance) {
    auto text = utterance.word_sequence;
    while (text.ends_with('.') || text.ends_with('!') || text.ends_with('?'))
      text.pop_back();
    return text;
  }

  Option<std::string> speaker_{this, "speaker", "you", "who speaks, as the robot calls them"};

private:
  Address heard_address() const { return here("requests that " + component_name() + " has heard"); }

  Option<SubarchitectureName> communication_{this, "communication", "communication",
                                             "the subarchitecture that hears requests"};
  /// Turn of the last move that was looked at.
  std::int32_t heard_ = -1;
};

} // namespace castor::planning
