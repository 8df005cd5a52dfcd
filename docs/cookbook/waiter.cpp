#include <castor/castor.hpp>
#include <cup.hpp>

using namespace std::chrono_literals;

class Waiter : public castor::UnmanagedComponent {
  void run() override {
    const castor::Address mug{"vision", "mug"};
    auto receiver = on_change(castor::added<Cup>().at(mug), [](const castor::ChangeEvent&) {});
    while (!exists(mug)) {
      if (!wait_for_changes(10s)) {
        warning("there is no mug after 10 s");
        return;
      }
    }
    remove_receiver(receiver);
    info("the mug is at {} m", read<Cup>(mug)->distance);
  }
};
CASTOR_COMPONENT(Waiter, "waits for the mug")
