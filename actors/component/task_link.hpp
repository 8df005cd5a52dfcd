#pragma once

#include "castor/actors/component/task.hpp"
#include "castor/actors/component/task_event.hpp"

namespace castor {

/// What managed components and their task managers say to each other.
class TaskLink {
public:
  virtual ~TaskLink() = default;

  // -- of a managed component

  virtual void propose(const TaskProposal& task) = 0;
  virtual void retract(const TaskId& id) = 0;
  virtual void complete(const TaskId& id, TaskOutcome outcome) = 0;

  // -- of a task manager

  /// Tells the component that proposed the task.
  virtual void decide(const TaskDecided& decision) = 0;
  /// Tells those who watch the system.
  virtual void report(const TaskEvent& event) = 0;
};

} // namespace castor
