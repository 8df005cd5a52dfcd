#pragma once

#include "castor/tools/chaos/fault.hpp"
#include "castor/tools/simulation/simulated_machines.hpp"
#include "castor/tools/simulation/testing_system.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>

namespace castor::simulation {

/// Scheduler of a simulated system: chooses the next actor to run, lets time pass, and injects
/// faults. Choices are drawn from the world's random numbers.
class SimulationSchedule {
public:
  /// Time counts from now.
  /// @param seed for random choices of faults
  SimulationSchedule(TestingSystem& stage, SystemWorld& world, SimulatedMachines& machines,
                     std::uint64_t seed);

  Timestamp time() const;
  caf::actor_clock::time_point begin() const { return begin_; }

  /// Schedules a fault at this time.
  void add_fault(Timestamp at, faults::Fault fault);

  /// Runs ready actors, in random order, until this time. Throws std::runtime_error if the system
  /// does not come to rest.
  void advance(Timestamp until);

  /// The same; returns true as soon as `enough` holds while no actor is ready.
  bool advance_until(Timestamp until, const std::function<bool()>& enough);

  /// Runs the ready actors of a process.
  void run_jobs_of(Life x);

  /// Number of steps: messages handled, or times that time passed.
  std::size_t steps() const { return steps_; }

private:
  std::size_t ready_job();
  Timestamp next_event();
  void let_time_pass(Timestamp x);

  TestingSystem& stage_;
  SystemWorld& world_;
  SimulatedMachines& machines_;
  const std::uint64_t seed_;
  const caf::actor_clock::time_point begin_;
  std::multimap<Timestamp, faults::Fault> due_;
  std::size_t steps_ = 0;
};

} // namespace castor::simulation
