#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/component/task.hpp"

#include <functional>
#include <string>
#include <unordered_map>

namespace castor {

/// A component whose activity its subarchitecture's task manager controls: for expensive processing
/// on demand. It proposes tasks, and executes those that are adopted.
class ManagedComponent : public SubarchitectureComponent {
protected:
  /// Proposes a task to the task manager; the decision arrives as a call of `task_adopted` or
  /// `task_rejected`. The options are for scheduling task managers:
  ///
  ///     propose_task("grasp", {.priority = 2, .cost = 0.5, .after = {reach}});
  TaskId propose_task(const std::string& name, TaskOptions options = {});

  /// Proposes a task that is executed by `work`, which is called when the task is adopted. When it
  /// returns, the task is complete: with success, or with failure if it throws; the exception is
  /// rethrown.
  TaskId propose_task(const std::string& name, std::function<void()> work,
                      TaskOptions options = {});

  /// Retracts a proposal. No decision on it arrives any more.
  void retract_task(const TaskId& id);

  /// Tells the task manager that an adopted task is over.
  void complete_task(const TaskId& id, TaskOutcome outcome);

  virtual void task_adopted(const TaskId&) {}
  virtual void task_rejected(const TaskId&) {}

private:
  friend class ComponentTasks;

  void decided(const TaskDecided& x);

  /// Tasks proposed and not complete, with the function to call on adoption; if it is empty,
  /// `task_adopted` is called.
  std::unordered_map<TaskId, std::function<void()>> tasks_;
  std::uint64_t tasks_made_ = 0;
};

} // namespace castor
