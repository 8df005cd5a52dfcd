#pragma once

#include "castor/actors/node/part.hpp"
#include "castor/actors/runtime/neighbours.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/tools/simulation/simulated_calls.hpp"
#include "castor/tools/simulation/simulated_client.hpp"
#include "castor/tools/simulation/simulated_network.hpp"
#include "castor/tools/simulation/simulated_tasks.hpp"
#include "castor/wm/entries/change_event.hpp"

#include <caf/resumable.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::simulation {

class SimulatedComponent;

/// The events that a component received in one incarnation.
struct Told {
  std::string component;
  std::uint64_t incarnation = 1;
  Life process = 0;
  std::vector<ChangeEventPtr> events;
  /// Time at which it received each.
  std::vector<Timestamp> times;
  /// The component is still running.
  bool alive = true;
};

/// State shared by all actors of one simulated system.
struct SystemWorld : linearizability::SimulatedWorld {
  using SimulatedWorld::SimulatedWorld;

  /// Adds an occurrence to the digest, which is the same for the same seed.
  void note(std::uint64_t x) { digest = (digest ^ x) * 0x100000001b3; }
  void note(const std::string& x) {
    for (auto c : x)
      note(static_cast<unsigned char>(c));
  }

  /// Adds a finding if this actor ends with an uncaught exception.
  void expect_no_exception(const caf::actor& x, const std::string& what);

  std::uint64_t digest = 0xcbf29ce484222325;
  /// The longest pause of a client between operations.
  std::chrono::milliseconds longest_pause{50};
  /// Running components by name.
  std::map<std::string, SimulatedComponent*> components;
  std::vector<std::shared_ptr<Told>> told;
  /// Process of each actor.
  std::map<const caf::resumable*, Life> owners;
  bool over = false;
  TaskLedger tasks;
  /// Number of tasks that components may still propose.
  std::size_t tasks_left = 0;
  TaskSchedule::Rules task_rules;
  CallLedger calls;
  /// Whether components serve calls.
  bool serves_calls = false;
  /// Total time by which clocks of working memories were put back.
  Timestamp clocks_behind{0};
  /// Runs all ready actors of a process until there are none.
  std::function<void(Life)> run_jobs_of;
};

/// To a component: makes a call to that subarchitecture. It answers whether there was a reply.
struct MakeCall {
  std::string subarchitecture;
};

/// To the component itself: the task is done.
struct TaskDone {
  TaskId id;
};

/// A component of a simulated system: follows the phase commands of its supervisor, receives every
/// event, and operates on working memories unless it is a task manager. It replaces the actor with
/// a thread of its own, which would not be deterministic.
class SimulatedComponent : public linearizability::SimulatedClient {
public:
  SimulatedComponent(caf::actor_config& config, SystemWorld& world,
                     linearizability::SimulatedClientParts parts,
                     std::shared_ptr<ComponentRecord> record, bool operates, Life process);

  const char* name() const override { return "simulated component"; }

  Life process() const { return process_; }
  const ComponentRecord& record() const { return *record_; }
  ComponentLife life() const {
    auto& identity = record_->identity();
    return {identity.name, identity.incarnation, process_};
  }
  /// Null for a component that is no task manager.
  const SimulatedTaskManager* task_manager() const { return manager_ ? &*manager_ : nullptr; }
  using SimulatedClient::number;

  void on_exit() override;

protected:
  caf::behavior make_behavior() override;
  WorkingMemoryActor way_to(std::size_t working_memory) const override;
  caf::duration deadline() const override { return caf::duration{std::chrono::seconds{1}}; }
  Timestamp pause() override;

private:
  void meet(NeighboursPtr neighbours);
  void enter(const EnterPhase& x);
  void register_filter();
  void phase_done(Phase phase);
  void fail(const std::string& why);
  void started();
  ClientPtr record_client() const;

  // -- tasks
  void propose_tasks();
  void decided(const TaskDecided& x);
  void complete(const TaskId& id);
  caf::actor manager_of_tasks() const;
  void begin_to_manage();

  // -- calls
  void call(const std::string& subarchitecture, SimulatedCalls::Answered answered);
  void hear(const ChangeNotice& x);
  void trace(const std::string& what) const;

  SystemWorld& system_world_;
  const std::shared_ptr<ComponentRecord> record_;
  const bool operates_;
  const Life process_;
  NeighboursPtr neighbours_;
  WorkingMemoryActor home_;
  caf::actor phase_controller_;
  std::optional<SimulatedTaskManager> manager_;
  /// Tasks that were proposed and are not over.
  std::map<TaskId, TaskProposal> tasks_;
  std::uint64_t last_task_ = 0;
  std::optional<SimulatedCalls> calls_;
  std::shared_ptr<Told> told_ = std::make_shared<Told>();
};

} // namespace castor::simulation

CASTOR_LOCAL_MESSAGE(castor::simulation::MakeCall)
CASTOR_LOCAL_MESSAGE(castor::simulation::TaskDone)
