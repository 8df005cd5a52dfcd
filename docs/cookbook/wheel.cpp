#include <castor/castor.hpp>

#include <chrono>

using namespace std::chrono_literals;

/// What the wheel is commanded to do.
struct Turn {
  double speed = 0;
};
CASTOR_REFLECT(Turn, speed)

/// Who holds a lease of this entry may turn the wheel.
struct Wheelhouse {};
CASTOR_REFLECT(Wheelhouse)

class Wheel : public castor::StandaloneComponent {
  void start() override {
    on_command<Turn>([this](const Turn& x) { set_speed(x.speed); }, [this] { set_speed(0); },
                     {.valid_for = 200ms, .lease = castor::Address{"navigation", "wheelhouse"}});
  }

  void set_speed(double speed) { info("speed {}", speed); }
};
CASTOR_COMPONENT(Wheel, "pretends to turn")

class Driver : public castor::UnmanagedComponent {
  void run() override {
    add(here("wheelhouse"), Wheelhouse{});
    auto lease = lock(here("wheelhouse"), castor::LockLevel::o);
    command("wheel", Turn{0.5});
    command("wheel", Turn{0.7});
    // No command after that: the wheel stops by itself.
    sleep_for(400ms);
    add(here("driven"), Wheelhouse{});
    sleep_for(1h);
  }
};
CASTOR_COMPONENT(Driver, "turns the wheel")

class Meddler : public castor::UnmanagedComponent {
  void start() override {
    on_change(castor::added<Wheelhouse>().at(here("driven")), [this](const castor::ChangeEvent&) {
      try {
        command("wheel", Turn{-1});
      } catch (const castor::CommandRefused& refusal) {
        info("{}", refusal.what());
      }
    });
  }
};
CASTOR_COMPONENT(Meddler, "turns the wheel without a lease")
