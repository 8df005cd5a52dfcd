#pragma once

#include "castor/actors/component/task.hpp"
#include "castor/actors/component/task_event.hpp"

namespace castor {

/// Connection between managed components and their task managers.
class TaskLink {
public:
  virtual ~TaskLink() = default;

  // -- of a managed component

  virtual void propose(const TaskProposal& task) = 0;
  virtual void retract(const TaskId& id) = 0;
  virtual void complete(const TaskId& id, TaskOutcome outcome) = 0;

  // -- of a task manager

  /// Sends the decision to the component that proposed the task.
  virtual void decide(const TaskDecided& decision) = 0;
  /// Sends the event to observers of the system.
  virtual void report(const TaskEvent& event) = 0;
};

} // namespace castor
