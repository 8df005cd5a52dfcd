#include <castor/castor.hpp>
#include <count.hpp>

class CountKeeper : public castor::UnmanagedComponent {
  void start() override {
    // A journal may have brought it back.
    if (!exists(here("count")))
      add(here("count"), Count{0});
  }

  void stop() override { info("the count is {}", read<Count>(here("count"))->value); }
};
CASTOR_COMPONENT(CountKeeper, "adds a count, and says in the end what it is")
