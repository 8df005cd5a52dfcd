#include <castor/castor.hpp>
#include <cup.hpp>

class Rule : public castor::CallbackComponent {
  void start() override {
    auto mine = castor::added<Cup>().where(castor::field(&Cup::distance) == at_.get());
    on_change(mine, [this](const castor::ChangeEvent& event) {
      read<Cup>(event.address).then([this](const castor::EntryOf<Cup>& cup) {
        info("a {}", cup->label);
        add(Cup{cup->distance / 2, "step towards the " + cup->label});
      });
    });
  }

  castor::Option<double> at_{this, "at", 1, "how far the cups are that it waits for, metres"};
};
CASTOR_COMPONENT(Rule, "halves the distance of a cup")
