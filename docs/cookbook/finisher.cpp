#include <castor/castor.hpp>
#include <cup.hpp>

class Finisher : public castor::UnmanagedComponent {
  void start() override {
    on_change(castor::added<Cup>().anywhere(), [this](const castor::ChangeEvent&) {
      if (++cups_ == 2)
        end_system(0, "both cups are there");
    });
  }

  int cups_ = 0;
};
CASTOR_COMPONENT(Finisher, "ends the system once two cups were added")
