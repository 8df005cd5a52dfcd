#pragma once

#include "castor/actors/task_manager/task_schedule.hpp"
#include "castor/base/caf.hpp"
#include "castor/tools/simulation/happenings.hpp"

#include <caf/actor.hpp>
#include <caf/actor_addr.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace castor::simulation {

/// A component in one incarnation, and its process.
struct ComponentLife {
  std::string component;
  std::uint64_t incarnation = 1;
  std::size_t process = 0;

  friend bool operator==(const ComponentLife&, const ComponentLife&) = default;
};

/// The simulated components' tasks and their states, to check the decisions of task managers.
class TaskLedger {
public:
  /// Whether one of two processes considers the other lost, so that it may consider the other's
  /// components ended.
  using HaveLost = std::function<bool(std::size_t, std::size_t)>;

  void set_have_lost(HaveLost x) { have_lost_ = std::move(x); }

  // -- by components
  void proposed(const TaskProposal& task, const ComponentLife& by);
  void retracted(const TaskId& id);
  void completed(const TaskId& id, TaskOutcome outcome);
  void ended(const std::string& component, std::uint64_t incarnation);

  // -- by task managers
  void received(const TaskId& id, const ComponentLife& manager);
  /// Checks a decision; returns an error message, empty if it is correct.
  std::string decided(const TaskDecided& x, const ComponentLife& manager, double budget);

  /// Errors after all activity has ended: tasks that could be adopted and are not.
  std::vector<std::string> overlooked(const std::vector<ComponentLife>& managers,
                                      double budget) const;

  const Happenings& happened() const { return happened_; }

private:
  enum class State : std::uint8_t { proposed, waiting, adopted, rejected, retracted, completed };

  struct Task {
    TaskProposal proposal;
    ComponentLife proposer;
    bool proposer_lives = true;
    State state = State::proposed;
    TaskOutcome outcome = TaskOutcome::success;
    /// The task manager that has received it, in its incarnation; empty if none has.
    ComponentLife manager;
    bool is_received = false;
  };

  bool succeeded(const TaskId& id) const;

  HaveLost have_lost_ = [](std::size_t, std::size_t) { return false; };
  std::map<TaskId, Task> tasks_;
  Happenings happened_;
};

/// Carries out the decisions of a TaskSchedule, as castor::TaskManager and its shell do.
class SimulatedTaskManager {
public:
  using Tell = std::function<void(const caf::actor& proposer, const TaskDecided&)>;

  SimulatedTaskManager(TaskSchedule::Rules rules, Tell tell)
    : schedule_(rules), tell_(std::move(tell)) {}

  void propose(const TaskProposal& task, const caf::actor& proposer);
  void retract(const TaskId& id);
  void complete(const TaskId& id, TaskOutcome outcome);
  /// A component has ended.
  void abandoned(const caf::actor_addr& proposer);

  /// Total cost of the adopted tasks.
  double used() const { return schedule_.used(); }

private:
  void carry_out(const TaskSchedule::Decisions& decisions);

  TaskSchedule schedule_;
  const Tell tell_;
  /// Proposers of the tasks that are not over.
  std::map<TaskId, caf::actor> proposers_;
};

} // namespace castor::simulation
