#include <castor/castor.hpp>
#include <cup.hpp>

struct HotCup : Cup {
  double celsius = 20;
};
CASTOR_REFLECT_DERIVED(HotCup, Cup, celsius)

class Barista : public castor::UnmanagedComponent {
  void start() override {
    on_change(castor::added<Cup>(), [this](const castor::ChangeEvent& event) {
      info("a {}: {}", event.type_name(), read<Cup>(event.address)->label);
    });
  }

  void run() override {
    add(Cup{1, "mug"});
    HotCup espresso;
    espresso.label = "espresso";
    espresso.celsius = 80;
    add(espresso);
  }

  void stop() override {
    info("{} cups, {} of them hot", read_all_derived<Cup>(subarchitecture()).size(),
         read_all<HotCup>().size());
  }
};
CASTOR_COMPONENT(Barista, "adds cups of two types")
