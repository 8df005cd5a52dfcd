#include "cup.hpp"

#include <castor/castor.hpp>

#include <chrono>

using namespace std::chrono_literals;

class Tracker : public castor::UnmanagedComponent {
  castor::Option<std::chrono::milliseconds> period_{this, "period", 250ms,
                                                    "time between two looks at the cup"};

  void run() override {
    auto address = add(Cup{2, ""});
    while (sleep_for(period_.get())) {
      auto guard = lock(address, castor::LockLevel::o);
      auto cup = *read<Cup>(address);
      if (cup.distance <= 0.5)
        return;
      cup.distance -= 0.25;
      overwrite(address, cup);
    }
  }
};
CASTOR_COMPONENT(Tracker, "follows a cup that comes nearer")
