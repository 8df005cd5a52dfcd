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

/// A component in one of its lives, and the process that it is in.
struct ComponentLife {
  std::string component;
  std::uint64_t incarnation = 1;
  std::size_t process = 0;

  friend bool operator==(const ComponentLife&, const ComponentLife&) = default;
};

/// What simulated components know of their tasks, which task managers are judged by.
class TaskLedger {
public:
  /// `have_lost`: whether two processes have given each other up, so that one may take the other's
  /// components for dead.
  using HaveLost = std::function<bool(std::size_t, std::size_t)>;

  void set_have_lost(HaveLost x) { have_lost_ = std::move(x); }

  // -- by components
  void proposed(const TaskProposal& task, const ComponentLife& by);
  void retracted(const TaskId& id);
  void completed(const TaskId& id, TaskOutcome outcome);
  void ended(const std::string& component, std::uint64_t incarnation);

  // -- by task managers
  void received(const TaskId& id, const ComponentLife& manager);
  /// What is wrong with the decision; empty if nothing is.
  std::string decided(const TaskDecided& x, const ComponentLife& manager, double budget);

  /// What is wrong once nothing happens any more: tasks that could be under way and are not.
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
    /// Who has it, in the life in which it does; none if nobody has received it.
    ComponentLife manager;
    bool is_received = false;
  };

  bool succeeded(const TaskId& id) const;

  HaveLost have_lost_ = [](std::size_t, std::size_t) { return false; };
  std::map<TaskId, Task> tasks_;
  Happenings happened_;
};

/// What castor::TaskManager and the shell around it do with the decisions of a TaskSchedule.
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

  /// What its adopted tasks cost.
  double used() const { return schedule_.used(); }

private:
  void carry_out(const TaskSchedule::Decisions& decisions);

  TaskSchedule schedule_;
  const Tell tell_;
  /// Of tasks that are not over.
  std::map<TaskId, caf::actor> proposers_;
};

} // namespace castor::simulation
