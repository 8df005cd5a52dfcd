#include <castor/castor.hpp>
#include <cup.hpp>

class Finder : public castor::UnmanagedComponent {
  void run() override {
    add(here("mug"), Cup{1, "mug"});
    add(here("glass"), Cup{2.5, "glass"});
  }
};
CASTOR_COMPONENT(Finder, "adds two cups")
