#include <castor/castor.hpp>
#include <cup.hpp>

class Warner : public castor::UnmanagedComponent {
  void start() override {
    auto nearer = castor::changed(&Cup::distance).where(castor::field(&Cup::distance) < 0.6);
    on_change(nearer, [this](const castor::ChangeEvent& event) {
      warning("the {} is near", read<Cup>(event.address)->label);
      put(here("warning"), Cup{0, "near"});
    });
  }
};
CASTOR_COMPONENT(Warner, "warns of cups that come near")
