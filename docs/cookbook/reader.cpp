#include <castor/castor.hpp>
#include <cup.hpp>

class Reader : public castor::UnmanagedComponent {
  void start() override {
    on_change(castor::added<Cup>().in("vision"), [this](const castor::ChangeEvent& event) {
      auto cup = read<Cup>(event.address);
      info("a {} at {} m, version {} by {}", cup->label, cup->distance, cup.version, cup.writer);
    });
  }

  void stop() override {
    info("vision has {} cups", read_all_in<Cup>("vision").size());
    for (auto& cup : read_where_in<Cup>("vision", castor::field(&Cup::distance) < 2.0))
      info("near: {}", to_string(cup.address));
  }
};
CASTOR_COMPONENT(Reader, "reads the cups of vision")
