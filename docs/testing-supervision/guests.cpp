#include <castor/castor.hpp>

using namespace castor;

struct Guest {
  int number = 0;
};
CASTOR_REFLECT(Guest, number)

struct Count {
  int guests = 0;
};
CASTOR_REFLECT(Count, guests)

class Door final : public UnmanagedComponent {
  void run() override {
    for (int i = 1; i <= guests_ && sleep_for(std::chrono::milliseconds{5}); ++i)
      add(Guest{i});
  }

  Option<int> guests_{this, "guests", 10, "how many come in"};
};
CASTOR_COMPONENT(Door, "lets guests in")

class Counter final : public ManagedComponent {
  void start() override {
    on_change(added<Guest>(), [this](const ChangeEvent&) { count(); });
    // Those that came while nobody was here to see them.
    count();
  }

  void count() {
    Count count{static_cast<int>(read_all<Guest>().size())};
    auto address = here("count");
    if (!exists(address)) {
      add(address, count);
      return;
    }
    read<Count>(address);
    overwrite(address, count);
  }
};
CASTOR_COMPONENT(Counter, "counts the guests")
