#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/tools/simulation/journal_check.hpp"
#include "castor/tools/simulation/simulated_machines.hpp"
#include "castor/tools/simulation/simulation_schedule.hpp"
#include "castor/tools/simulation/testing_system.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace castor::simulation {

/// Checks of a simulated system after all faults are over and everything is up again: nothing is
/// left of ended components, of calls and of tasks, and all components have received all events.
/// Failed checks are added to the world's findings.
class FinalChecks {
public:
  FinalChecks(TestingSystem& stage, SimulationSchedule& schedule, SystemWorld& world,
              const SimulatedMachines& machines, const ArchitectureDescription& architecture,
              std::chrono::milliseconds lease)
    : stage_(stage), schedule_(schedule), world_(world), machines_(machines),
      architecture_(architecture), lease_(lease) {}

  /// Throws std::runtime_error if a check cannot be made.
  void run();

  /// To be called after `run`.
  const JournalCounts& journal_counts() const { return journal_counts_; }

private:
  void check_ended_clients();
  void check_calls();
  void check_nothing_left(const std::string& name, const std::string& type,
                          const WorkingMemoryActor& memory);
  void check_tasks();
  void leave_sentinels();
  void look_at(std::uint32_t entry);
  void check_memory(const std::string& name, const MemoryLife& memory);
  void check_told(const Told& told);
  void check_health();

  WorkingMemoryActor owner_of(const SystemWorld::SimulatedEntry& x) const;

  template <class Reply, class Request>
  Reply ask(const WorkingMemoryActor& to, const Request& request) {
    auto result = stage_.answer_of<Reply>(to, request);
    if (!result)
      throw std::runtime_error{"a working memory does not answer"};
    return *std::move(result);
  }

  TestingSystem& stage_;
  SimulationSchedule& schedule_;
  SystemWorld& world_;
  const SimulatedMachines& machines_;
  const ArchitectureDescription& architecture_;
  const std::chrono::milliseconds lease_;
  JournalCounts journal_counts_;
};

} // namespace castor::simulation
