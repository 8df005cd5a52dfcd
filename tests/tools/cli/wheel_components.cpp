// A wheel on a stick, and drivers of which each makes the trips that are wanted: only the holder of
// the lease may turn the wheel.
#include "castor/actors/component/registry.hpp"

#include <chrono>
#include <string>
#include <utility>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

/// What the wheel is commanded to do.
struct Turn {
  double speed = 0;
};
CASTOR_REFLECT(Turn, speed)

/// The holder of the lease of this entry may turn the wheel.
struct Wheelhouse {};
CASTOR_REFLECT(Wheelhouse)

/// A trip that any driver may make. It is deleted when it is done.
struct Trip {
  int commands = 25;
  /// Empty until somebody begins it.
  std::string driver;
};
CASTOR_REFLECT(Trip, commands, driver)

class TestWheel final : public StandaloneComponent {
  void start() override {
    on_command<Turn>([this](const Turn& x) { set_speed(x.speed); }, [this] { set_speed(0); },
                     {.valid_for = 100ms, .lease = Address{"drive", "wheelhouse"}});
  }

  void set_speed(double speed) {
    if (std::exchange(speed_, speed) != speed)
      info("turns with speed {}", speed);
  }

  double speed_ = 0;
};
CASTOR_COMPONENT(TestWheel, "obeys the holder of the lease of drive/wheelhouse")

class TripDriver final : public UnmanagedComponent {
  void start() override {
    on_change(changed<Trip>(), [](const ChangeEvent&) {});
  }

  void run() override {
    while (is_running()) {
      try {
        auto trips = read_all<Trip>();
        if (trips.empty())
          wait_for_changes();
        else
          make(trips.back());
      } catch (const ConnectionError& e) {
        // It has lost the lease, or the wheel is out of reach.
        debug("{}", e.what());
        sleep_for(10ms);
      } catch (const WorkingMemoryException& e) {
        // Another driver has made the trip, or the working memory is out of reach.
        debug("{}", e.what());
        sleep_for(10ms);
      }
    }
  }

  void make(const EntryOf<Trip>& trip) {
    command_without_lease();
    auto lease = lock_wheelhouse();
    auto now = read<Trip>(trip.address);
    overwrite(trip.address, Trip{now->commands, component_name()});
    for (int i = 0; i < now->commands && sleep_for(10ms); ++i)
      stream_command("wheel", Turn{1});
    delete_entry(trip.address);
  }

  /// Has to be refused: "commands with valid tokens" would be violated.
  void command_without_lease() {
    try {
      command("wheel", Turn{-1});
    } catch (const CommandRefused& e) {
      debug("{}", e.what());
    }
  }

  /// The entry is gone if its working memory was restarted.
  LockGuard lock_wheelhouse() {
    auto wheelhouse = here("wheelhouse");
    if (!exists(wheelhouse))
      add(wheelhouse, Wheelhouse{});
    return lock(wheelhouse, LockLevel::o);
  }
};
CASTOR_COMPONENT(TripDriver, "makes trips while it holds the lease of the wheel")

/// Turns the wheel once.
class Pusher final : public UnmanagedComponent {
  void run() override {
    add(here("wheelhouse"), Wheelhouse{});
    auto lease = lock(here("wheelhouse"), LockLevel::o);
    command("wheel", Turn{1});
    stream_command("wheel", Turn{1});
    info("the wheel has obeyed");
    end_system(0, "the wheel has obeyed");
  }
};
CASTOR_COMPONENT(Pusher, "turns the wheel once")

} // namespace

} // namespace castor::test
