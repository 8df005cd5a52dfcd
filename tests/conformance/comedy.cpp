#include "castor/tests/conformance/tester.hpp"

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/actors/component/registry.hpp"

#include <chrono>
#include <string>

/// Two comedians and their audience: components that know nothing of one another and meet on
/// working memory.
namespace castor::conformance {

namespace {

struct Joke {
  std::string setup;
  std::string punchline;
};
CASTOR_REFLECT(Joke, setup, punchline)

struct Reaction {
  EntryPointer<Joke> joke;
  std::string text;
};
CASTOR_REFLECT(Reaction, joke, text)

class StraightMan final : public ManagedComponent {
  void start() override {
    on_change(added<Reaction>().anywhere(), [this](const ChangeEvent& event) {
      auto reaction = read<Reaction>(event.address);
      answered_ = answered_ || reaction->joke.address == joke_;
    });
  }

  void run() override {
    for (int i = 1; i <= jokes_; ++i) {
      answered_ = false;
      info("{}", setup_.get());
      joke_ = add(Joke{setup_, {}});
      while (!answered_)
        if (!wait_for_changes(patience_.get()))
          return end_system(failed_status, "nobody reacts to joke " + std::to_string(i));
      if (read<Joke>(joke_)->punchline.empty())
        return end_system(failed_status, "somebody reacted to a joke without a punchline");
    }
    end_system(passed_status, "the performance is over");
  }

  Address joke_;
  bool answered_ = false;

  Option<std::string> setup_{this, "setup", "Why did the robot cross the road?",
                             "how a joke begins"};
  Option<int> jokes_{this, "jokes", 3, "how many jokes make a performance"};
  Option<std::chrono::milliseconds> patience_{this, "patience", std::chrono::seconds{10},
                                              "how long a reaction may take"};
};
CASTOR_COMPONENT(StraightMan, "begins a joke, waits for a reaction, and begins the next")

class FunnyMan final : public ManagedComponent {
  void start() override {
    on_change(added<Joke>(), [this](const ChangeEvent& event) {
      propose_task("finish " + to_string(event.address),
                   [this, address = event.address] { finish(address); });
    });
  }

  void finish(const Address& address) {
    auto joke = *read<Joke>(address);
    joke.punchline = punchline_;
    info("{}", joke.punchline);
    overwrite(address, joke);
  }

  Option<std::string> punchline_{this, "punchline", "To get to the other site.", "how a joke ends"};
};
CASTOR_COMPONENT(FunnyMan, "gives every joke that is begun a punchline, as a task")

class AudienceMember final : public ManagedComponent {
  void start() override {
    on_change(overwritten<Joke>().anywhere(), [this](const ChangeEvent& event) {
      info("{}", reaction_.get());
      add(Reaction{{event.address}, reaction_});
    });
  }

  Option<std::string> reaction_{this, "reaction", "Ha ha ha.", "what it makes of a joke"};
};
CASTOR_COMPONENT(AudienceMember, "reacts to every joke that has got its punchline")

} // namespace

} // namespace castor::conformance
