#pragma once

#include "castor/actors/runtime/shell_protocol.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>

namespace castor {

/// Thrown where a component that is to crash calls the runtime. It derives from nothing, so that
/// no handler of std::exception swallows it.
struct InjectedCrash {};

/// The faults that were injected into a component. Used on the component's own thread only.
class InjectedFaults {
public:
  using Clock = std::chrono::steady_clock;

  void take(const ComponentFault& x, Clock::time_point now);

  /// Throws InjectedCrash if the component is to crash.
  void at_runtime() const {
    if (crash_)
      throw InjectedCrash{};
  }

  /// Where a phase of its life begins: may take its time.
  void in_phase(Phase x);

  /// Where a callback begins: may take its time, and throw std::runtime_error.
  void in_callback();

private:
  bool crash_ = false;
  /// So many callbacks from now, one throws; 0 for none.
  std::uint32_t failure_in_ = 0;
  FaultTicket failure_ticket_;
  std::optional<Timestamp> hang_;
  FaultTicket hang_ticket_;
  struct Blocked {
    Timestamp by{0};
    FaultTicket ticket;
  };
  std::map<Phase, Blocked> blocked_;
  Timestamp slowness_{0};
  Clock::time_point slow_until_;
  FaultTicket slowness_ticket_;
};

} // namespace castor
