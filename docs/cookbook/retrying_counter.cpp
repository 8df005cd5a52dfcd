#include <castor/castor.hpp>
#include <count.hpp>

class RetryingCounter : public castor::UnmanagedComponent {
  void run() override {
    for (int i = 0; i < 100; ++i)
      add_one(here("count"));
  }

  void add_one(const castor::Address& address) {
    while (true) {
      auto count = *read<Count>(address);
      ++count.value;
      try {
        overwrite(address, count);
        return;
      } catch (const castor::ConsistencyException&) {
        // Somebody wrote after the read: read again.
      }
    }
  }
};
CASTOR_COMPONENT(RetryingCounter, "counts to 100, without a lock")
