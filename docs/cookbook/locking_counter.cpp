#include <castor/castor.hpp>
#include <count.hpp>

class LockingCounter : public castor::UnmanagedComponent {
  void run() override {
    for (int i = 0; i < 100; ++i)
      add_one(here("count"));
  }

  void add_one(const castor::Address& address) {
    auto guard = lock(address, castor::LockLevel::o);
    auto count = *read<Count>(address);
    ++count.value;
    overwrite(address, count);
  } // Here the lock ends, also after an exception.
};
CASTOR_COMPONENT(LockingCounter, "counts to 100, with a lock")
