#include <castor/castor.hpp>
#include <cup.hpp>

class Mover : public castor::UnmanagedComponent {
  void run() override {
    Cup cup{1, "mug"};
    auto address = add(cup);
    for (int i = 0; i < 4; ++i) {
      cup.distance -= 0.125;
      overwrite(address, cup);
    }
  }
};
CASTOR_COMPONENT(Mover, "moves a cup nearer, four times")
