#include <castor/castor.hpp>
#include <count.hpp>

#include <cstdlib>

class Fragile : public castor::UnmanagedComponent {
  void run() override {
    auto address = here("crashes");
    if (exists(address)) {
      info("is back, and goes on");
      return;
    }
    add(address, Count{1});
    std::abort();
  }
};
CASTOR_COMPONENT(Fragile, "aborts the first time")
