#include "castor/actors/component/managed_component.hpp"

#include "castor/actors/component/component_runtime.hpp"

#include <exception>
#include <utility>

namespace castor {

TaskId ManagedComponent::propose_task(const std::string& name, TaskOptions options) {
  return propose_task(name, nullptr, std::move(options));
}

TaskId ManagedComponent::propose_task(const std::string& name, std::function<void()> work,
                                      TaskOptions options) {
  auto& self = runtime().identity();
  // The tasks of a former life are others.
  auto life = self.incarnation == 1 ? std::string{} : fmt::format(".{}", self.incarnation);
  auto id = fmt::format("task:{}{}:{}", self.name, life, ++tasks_made_);
  tasks_[id] = std::move(work);
  runtime().tasks().propose({id, name, component_name(), std::move(options)});
  return id;
}

void ManagedComponent::retract_task(const TaskId& id) {
  if (tasks_.erase(id) > 0)
    runtime().tasks().retract(id);
}

void ManagedComponent::complete_task(const TaskId& id, TaskOutcome outcome) {
  if (tasks_.erase(id) > 0)
    runtime().tasks().complete(id, outcome);
}

void ManagedComponent::decided(const TaskDecided& x) {
  auto& id = x.id;
  auto i = tasks_.find(id);
  if (i == tasks_.end())
    return; // retracted meanwhile
  switch (x.decision) {
    case TaskDecision::waiting:
      debug("{} has to wait: {}", id, x.reason);
      break;
    case TaskDecision::rejected:
      debug("{} is rejected: {}", id, x.reason);
      tasks_.erase(i);
      task_rejected(id);
      break;
    case TaskDecision::adopted:
      if (auto work = i->second) {
        try {
          work();
        } catch (const std::exception&) {
          complete_task(id, TaskOutcome::failure);
          throw;
        }
        complete_task(id, TaskOutcome::success);
      } else {
        task_adopted(id);
      }
      break;
  }
}

} // namespace castor
