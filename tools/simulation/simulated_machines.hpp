#pragma once

#include "castor/actors/node/memberships.hpp"
#include "castor/tools/chaos/fault.hpp"
#include "castor/tools/simulation/memory_life.hpp"
#include "castor/tools/simulation/simulated_component.hpp"
#include "castor/tools/simulation/simulated_journal.hpp"
#include "castor/tools/simulation/simulated_network.hpp"
#include "castor/tools/simulation/system_faults.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <caf/resumable.hpp>

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::simulation {

/// The machines of a simulated system, their processes, and fault injection into these.
class SimulatedMachines {
public:
  using Machine = std::size_t;
  using Clock = std::chrono::steady_clock;

  /// @param count number of machines: the coordinator's and those of the nodes
  SimulatedMachines(caf::actor_system& system, SystemWorld& world, std::size_t count);
  SimulatedMachines(const SimulatedMachines&) = delete;
  SimulatedMachines& operator=(const SimulatedMachines&) = delete;

  static LinkOptions link_options();
  static Endpoint endpoint_of(Machine x);

  std::size_t count() const { return count_; }
  SimulatedNetwork& network() { return network_; }

  /// Factories for the actors and links of a machine's process.
  PartSpawn spawn(Machine x);
  LinkSpawn spawn_link(Machine x);

  /// Starts a node's process in place of any earlier one.
  void start_node(Machine x);
  bool is_there(Machine x) const { return processes_[x].there; }

  // -- injected faults

  void inject(const faults::Fault& x, std::uint64_t seed);
  /// Restarts and resumes the processes that are due.
  void catch_up();
  /// Ends all faults of machines and processes.
  void heal();
  /// Time at which the next process has to restart or resume.
  Clock::time_point next_event() const;

  bool may_run(const caf::resumable* x) const;
  bool all_may_run() const { return frozen_.empty() && hanging_.empty(); }

  // -- what there is

  /// By subarchitecture.
  const std::map<std::string, std::vector<MemoryLife>>& memories() const { return memories_; }
  /// Whether one of these processes considers the other lost.
  bool have_lost(Life a, Life b) const {
    return lost_.count({a, b}) > 0 || lost_.count({b, a}) > 0;
  }
  /// Whether a fault has affected processes or their links.
  bool are_processes_affected() const { return processes_affected_; }

  /// The disk of the machine that a process runs on.
  const SimulatedDisk& disk_of(Life x) const { return disks_[machine_of(x)]; }

  /// Ends all processes.
  void end();

private:
  struct Process {
    Life life = 0;
    bool there = false;
    std::shared_ptr<Memberships> node;
    caf::actor listener;
  };

  struct Link {
    caf::actor actor;
    Life life = 0;
    std::string peer;
  };

  struct Silence {
    Machine a = 0;
    Machine b = 0;
    Clock::time_point until;
  };

  Clock::time_point now() const { return system_.clock().now(); }
  Machine machine(std::string_view name) const;
  Machine machine_of(Life x) const;
  /// Assigns an actor to a process.
  /// @param what name of the actor in findings
  void own(const caf::actor& x, Life life, const std::string& what);
  WorkingMemoryActor spawn_working_memory(WorkingMemoryOptions options, Life life);
  caf::actor spawn_component(const ShellParts& parts, Life life);
  void hear(Life life, const caf::actor& link, const LinkNews& news);
  /// From now on the process considers the other one lost, with all its actors.
  void give_up(Life life, Life other);

  caf::actor spawn_journal_writer(Life life);
  /// Null if the working memory is not running.
  WorkingMemoryActor memory(const std::string& subarchitecture) const;
  void jump_clock(const faults::JumpClock& x);
  /// Delays writes to the journal from now on.
  void slow_journal(const faults::SlowJournal& x);
  void stop(Machine x, Clock::duration duration);

  void crash(const std::string& name);
  void hang(const faults::Hang& x);
  void kill(Machine x, std::chrono::milliseconds back_after);
  void silence(Machine a, Machine b, Clock::duration x);
  void inject_into_link(Machine a, Machine b, const LinkFault& x);
  void inject_into_link(const faults::LinkTarget& link, const LinkFault& x);

  caf::actor_system& system_;
  SystemWorld& world_;
  const std::size_t count_;
  SimulatedNetwork network_;
  std::array<Process, machine_names.size()> processes_;
  Life last_life_ = machine_names.size() - 1;
  std::vector<Machine> machine_of_life_;
  std::vector<Link> links_;
  std::array<SimulatedDisk, machine_names.size()> disks_;
  /// Writers with their processes.
  std::vector<std::pair<caf::actor, Life>> journal_writers_;
  std::vector<Silence> silences_;
  std::map<Machine, Clock::time_point> returns_;
  std::map<Life, Clock::time_point> frozen_;
  std::map<const caf::resumable*, Clock::time_point> hanging_;
  std::map<std::string, std::vector<MemoryLife>> memories_;
  /// By link: the process with which it had a connection.
  std::map<caf::actor, Life> peers_;
  std::set<std::pair<Life, Life>> lost_;
  bool processes_affected_ = false;
};

/// The actor, as the scheduler sees it.
template <class Handle>
const caf::resumable* job_of(const Handle& x) {
  return dynamic_cast<const caf::resumable*>(caf::actor_cast<caf::abstract_actor*>(x));
}

} // namespace castor::simulation
