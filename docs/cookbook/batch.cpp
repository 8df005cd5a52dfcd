#include <castor/castor.hpp>
#include <count.hpp>

class Transfer : public castor::UnmanagedComponent {
  void run() override {
    auto left = add(Count{10});
    auto right = add(Count{0});
    write(castor::WriteBatch{}.overwrite(left, Count{7}).overwrite(right, Count{3}));

    castor::WriteBatch batch;
    batch.delete_entry(left).overwrite(here("nothing"), Count{1});
    try {
      write(batch);
    } catch (const castor::DoesNotExistOnWM& e) {
      info("{}; left is still {}", e.what(), read<Count>(left)->value);
    }
  }
};
CASTOR_COMPONENT(Transfer, "moves from one count to another")
