#include "cup.hpp"

#include <castor/castor.hpp>

class Labeller : public castor::UnmanagedComponent {
  castor::Option<double> range_{this, "range", 1.2, "how near a cup has to be, metres"};

  void start() override {
    auto near_and_nameless =
      castor::field(&Cup::distance) < range_.get() && castor::field(&Cup::label) == "";
    on_change(castor::changed(&Cup::distance).where(near_and_nameless),
              [this](const castor::ChangeEvent& event) { label(event.address); });
  }

  void label(const castor::Address& address) {
    auto guard = lock(address, castor::LockLevel::o);
    auto cup = *read<Cup>(address);
    // The event is history: while this component waited, the cup may have got a label.
    if (!cup.label.empty())
      return;
    cup.label = "mug";
    overwrite(address, cup);
    info("the cup is a {}", cup.label);
  }

  void stop() override {
    auto known = read_where<Cup>(castor::field(&Cup::label) != "");
    for (auto& cup : known)
      info("a {} stands {} m away", cup->label, cup->distance);
  }
};
CASTOR_COMPONENT(Labeller, "says what a cup is once it is near enough")
