#include <castor/castor.hpp>
#include <cup.hpp>

#include <chrono>

using namespace std::chrono_literals;

class Forgetter : public castor::UnmanagedComponent {
  void run() override {
    add(here("sighting"), Cup{1, "seen once"}, {.time_to_live = 200ms});
    add(here("mine"), Cup{1, "gone with this component"}, {.ephemeral = true});
    add(here("far"), Cup{9, "too far"});
    for (auto& cup : read_where<Cup>(castor::field(&Cup::distance) > 5.0))
      delete_entry(cup.address);
  }
};
CASTOR_COMPONENT(Forgetter, "adds what goes again")
