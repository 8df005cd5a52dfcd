#pragma once

#include "castor/tools/chaos/fault.hpp"
#include "castor/tools/simulation/simulated_machines.hpp"
#include "castor/tools/simulation/testing_system.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>

namespace castor::simulation {

/// Who runs next in a simulated system, when time passes, and when faults are injected. What is
/// left open is drawn from the world's random numbers.
class SimulationSchedule {
public:
  /// Time counts from now. Of what is injected, `seed` draws what the faults leave open.
  SimulationSchedule(TestingSystem& stage, SystemWorld& world, SimulatedMachines& machines,
                     std::uint64_t seed);

  Timestamp time() const;
  caf::actor_clock::time_point begin() const { return begin_; }

  /// Injects a fault at that time.
  void add_fault(Timestamp at, faults::Fault fault);

  /// Runs who is ready, in any order, until then. Throws std::runtime_error if the system does not
  /// come to rest.
  void advance(Timestamp until);

  /// The same; true as soon as it is enough when nobody is ready.
  bool advance_until(Timestamp until, const std::function<bool()>& enough);

  /// Runs who is ready in a process.
  void run_jobs_of(Life x);

  /// How many messages were worked off, or how often time passed.
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
