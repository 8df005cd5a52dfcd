#pragma once

#include "castor/actors/component/lock_guard.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/wm/entries/failure.hpp"

#include <optional>
#include <string>
#include <utility>

namespace castor {

/// A component that commands an effector from a seat: an entry with the name of who sits in it. With
/// `--lease`, an effector obeys only who has the lease of that entry.
/// @tparam Seat record of one std::string, the component
template <ReflectedRecord Seat>
class CommandsFromSeat : public UnmanagedComponent {
protected:
  /// Waits until nobody else sits there. Does nothing without a seat.
  void take_seat() {
    if (seat_->empty())
      return;
    const auto seat = here(seat_);
    if (!exists(seat)) {
      try {
        add(seat, Seat{});
      } catch (const AlreadyExistsOnWM&) {
        debug("somebody else has added {}", to_string(seat));
      }
    }
    lease_.emplace(lock(seat, LockLevel::o));
    put(seat, Seat{component_name()});
  }

  void leave_seat() { lease_.reset(); }

  /// Does not wait for the effector. Takes the seat again if it was lost: who hangs for a while loses
  /// it. False if an earlier command was refused, which is logged once until the next success.
  template <ReflectedRecord Command>
  bool command_from_seat(const std::string& effector, Command x) {
    if (lease_ && !lease_->held()) {
      warning("has lost the seat, and takes it again");
      leave_seat();
      take_seat();
    }
    try {
      stream_command(effector, std::move(x));
      refusal_.clear();
      return true;
    } catch (const ConnectionError& e) {
      if (refusal_.empty())
        warning("{}", e.what());
      refusal_ = e.what();
      return false;
    }
  }

  /// Why the newest command was refused; empty if it was not.
  const std::string& refusal() const { return refusal_; }

private:
  Option<std::string> seat_{this, "seat", "",
                            "id of the entry to lock for commanding, in this subarchitecture"};
  std::optional<LockGuard> lease_;
  std::string refusal_;
};

} // namespace castor
