#pragma once

#include "castor/actors/component/component.hpp"
#include "castor/actors/task_manager/task.hpp"

#include <string>
#include <unordered_map>

namespace castor {

/// Decides which of the tasks that a subarchitecture's managed components propose are done, and
/// when. It sees proposals, not working memory.
class TaskManager : public Component {
protected:
  /// A task was proposed. Decide now or later; a task that is not decided waits.
  virtual void task_proposed(const TaskProposal& task) = 0;

  /// A proposal was taken back. Not called for tasks that were rejected.
  virtual void task_retracted(const TaskProposal&) {}

  /// An adopted task is over.
  virtual void task_completed(const TaskProposal&, TaskOutcome) {}

  /// Tells the proposing component; ids that are unknown or retracted are ignored.
  void decide(const TaskId& id, TaskDecision decision);

private:
  friend class ComponentShell;

  void proposed(TaskProposal task);
  void retracted(const TaskId& id);
  void completed(const TaskId& id, TaskOutcome outcome);

  std::unordered_map<TaskId, TaskProposal> tasks_;
};

} // namespace castor
