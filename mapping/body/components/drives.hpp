#pragma once

#include "castor/actors/component/lock_guard.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <optional>
#include <string>

namespace castor::mapping {

/// A component that commands a robot, in its seat if there is one: robots with `--lease` obey only
/// who sits in it.
class Drives : public UnmanagedComponent {
protected:
  /// Waits until nobody else sits there. Does nothing without a seat.
  void take_seat() {
    if (seat_->empty())
      return;
    const auto seat = here(seat_);
    if (!exists(seat)) {
      try {
        add(seat, DriverSeat{});
      } catch (const AlreadyExistsOnWM&) {
        debug("somebody else has added {}", to_string(seat));
      }
    }
    lease_.emplace(lock(seat, LockLevel::o));
    put(seat, DriverSeat{component_name()});
  }

  void leave_seat() { lease_.reset(); }

  /// Does not wait for the robot. Takes the seat again if it was lost: who hangs for a while loses
  /// it. A refusal is logged, once until the next success.
  void drive(const Twist2& velocity) {
    if (lease_ && !lease_->held()) {
      warning("has lost the seat, and takes it again");
      leave_seat();
      take_seat();
    }
    try {
      stream_command(robot_.get(), DriveCommand{velocity});
      is_refused_ = false;
    } catch (const ConnectionError& e) {
      if (!is_refused_)
        warning("{}", e.what());
      is_refused_ = true;
    }
  }

  /// Whose pushes count.
  const std::string& sensors() const { return sensors_->empty() ? robot_.get() : sensors_.get(); }

  Option<StandaloneName> robot_{this, "robot", "robot", "the robot to drive"};
  Option<StandaloneName> sensors_{
    this, "sensors", "",
    "whose pushes count, if another component takes the commands; empty: the robot"};
  Option<std::string> seat_{this, "seat", "",
                            "id of the entry to lock for driving, in this subarchitecture"};

private:
  std::optional<LockGuard> lease_;
  bool is_refused_ = false;
};

} // namespace castor::mapping
