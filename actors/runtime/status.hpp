#pragma once

#include "castor/actors/runtime/record.hpp"

#include <chrono>
#include <cstdint>
#include <string>

namespace castor {

/// Snapshot of a component, in any process.
struct ComponentStatus {
  ComponentIdentity identity;
  bool is_task_manager = false;
  ComponentState state = ComponentState::created;
  /// Its node does not answer, but is not lost yet: the other values are not known.
  bool out_of_reach = false;
  /// How often it was started again.
  std::uint64_t restarts = 0;
  /// It has ended, and will be started again.
  bool will_restart = false;
  /// Why it failed; empty if it did not.
  std::string failure;
  /// Time since it was last idle; 0 while it is idle.
  std::chrono::nanoseconds busy{0};
  /// CPU time of its thread.
  std::chrono::nanoseconds cpu{0};

  std::uint64_t events_received = 0;
  /// Of these, those that none of its filters matches, in a system that broadcasts.
  std::uint64_t events_rejected = 0;
  std::uint64_t callbacks = 0;
  std::uint64_t reads = 0;
  std::uint64_t writes = 0;
  /// Pushes that a receiver was too slow for.
  std::uint64_t pushes_dropped = 0;
  /// Whose commands it obeys now, such as "driver of navigation"; empty for nobody's.
  std::string obeys;
};

/// State for people: the name of the state, or "restarting".
std::string state_of(const ComponentStatus& x);

/// Whether it keeps a system from being quiet: it has been busy for longer than one that merely
/// polls, or has started and has not begun to run.
bool has_work(const ComponentStatus& x);

ComponentStatus status_of(const ComponentRecord& x, ComponentRecord::Clock::time_point now);

} // namespace castor
