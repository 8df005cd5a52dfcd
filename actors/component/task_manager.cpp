#include "castor/actors/component/task_manager.hpp"

#include "castor/actors/component/component_runtime.hpp"

#include <utility>

namespace castor {

namespace {

TaskStep step_of(TaskDecision x) {
  switch (x) {
    case TaskDecision::adopted:
      return TaskStep::adopted;
    case TaskDecision::rejected:
      return TaskStep::rejected;
    case TaskDecision::waiting:
      return TaskStep::waiting;
  }
  return TaskStep::waiting;
}

std::string text_of(TaskOutcome outcome) {
  for (auto& [name, value] : reflection_of<TaskOutcome>().enumerators)
    if (value == outcome)
      return std::string{name};
  return {};
}

} // namespace

void TaskManager::decide(const TaskId& id, TaskDecision decision, const std::string& reason) {
  auto i = tasks_.find(id);
  if (i == tasks_.end())
    return;
  report(step_of(decision), i->second, reason);
  runtime().tasks().decide({id, decision, reason});
  if (decision == TaskDecision::rejected)
    tasks_.erase(i);
}

void TaskManager::proposed(TaskProposal task) {
  auto i = tasks_.insert_or_assign(task.id, std::move(task)).first;
  task_proposed(TaskProposal{i->second});
}

void TaskManager::retracted(const TaskId& id) {
  if (auto node = tasks_.extract(id)) {
    report(TaskStep::retracted, node.mapped(), {});
    task_retracted(node.mapped());
  }
}

void TaskManager::completed(const TaskId& id, TaskOutcome outcome) {
  if (auto node = tasks_.extract(id)) {
    report(TaskStep::completed, node.mapped(), text_of(outcome));
    task_completed(node.mapped(), outcome);
  }
}

void TaskManager::abandoned(const std::vector<TaskId>& ids, bool failed) {
  // All of them are gone before the first retraction lets others in, lest one of them be adopted.
  std::vector<TaskProposal> tasks;
  for (auto& id : ids)
    if (auto node = tasks_.extract(id))
      tasks.push_back(std::move(node.mapped()));
  for (auto& x : tasks)
    report(TaskStep::retracted, x, x.component + (failed ? " failed" : " stopped"));
  for (auto& x : tasks)
    task_retracted(x);
}

void TaskManager::report(TaskStep step, const TaskProposal& task, std::string detail) {
  debug("{} {} of {}: {}{}", to_string(step), task.id, task.component, task.name,
        detail.empty() ? "" : " (" + detail + ")");
  runtime().tasks().report(
    {step, runtime().identity().subarchitecture, task, std::move(detail), now()});
}

} // namespace castor
