#pragma once

#include "castor/actors/runtime/shell_protocol.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>

namespace castor {

/// Injected crash, thrown when the component calls the runtime. It has no base class, so that no
/// handler of std::exception swallows it.
struct InjectedCrash {};

/// The faults that were injected into a component. Used on the component's own thread only.
class InjectedFaults {
public:
  using Clock = std::chrono::steady_clock;

  void take(const ComponentFault& x, Clock::time_point now);

  /// Throws InjectedCrash if a crash was injected.
  void at_runtime() const {
    if (crash_)
      throw InjectedCrash{};
  }

  /// Called at the beginning of a phase: blocks if that was injected.
  void in_phase(Phase x);

  /// Called at the beginning of a callback: blocks, or throws std::runtime_error, if that was
  /// injected.
  void in_callback();

private:
  bool crash_ = false;
  /// Number of callbacks until one throws; 0 for none.
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
