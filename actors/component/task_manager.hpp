#pragma once

#include "castor/actors/component/component.hpp"
#include "castor/actors/component/task.hpp"
#include "castor/actors/component/task_event.hpp"

#include <string>
#include <unordered_map>
#include <vector>

namespace castor {

/// Decides which tasks proposed by a subarchitecture's managed components are executed, and when.
/// It sees proposals, not working memory.
class TaskManager : public Component {
protected:
  /// A task was proposed. Decide now or later; a task that is not decided waits.
  virtual void task_proposed(const TaskProposal& task) = 0;

  /// A proposal, adopted or not, was retracted, or its component has ended. Not called for tasks
  /// that were rejected.
  virtual void task_retracted(const TaskProposal&) {}

  /// An adopted task is over.
  virtual void task_completed(const TaskProposal&, TaskOutcome) {}

  /// Sends the decision to the proposing component and to observers of the system; ids that are
  /// unknown or retracted are ignored. `reason` says why a task waits or is rejected.
  void decide(const TaskId& id, TaskDecision decision, const std::string& reason = {});

private:
  friend class ComponentTasks;

  void proposed(TaskProposal task);
  void retracted(const TaskId& id);
  void completed(const TaskId& id, TaskOutcome outcome);
  /// The component that proposed these tasks has ended.
  void abandoned(const std::vector<TaskId>& ids, bool failed);

  void report(TaskStep step, const TaskProposal& task, std::string detail);

  std::unordered_map<TaskId, TaskProposal> tasks_;
};

} // namespace castor
