#include "castor/actors/runtime/component_tasks.hpp"

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/task_manager.hpp"

#include <utility>
#include <vector>

namespace castor {

ComponentTasks::ComponentTasks(Component& component, const Parts& parts)
  : parts_(parts), managed_(dynamic_cast<ManagedComponent*>(&component)),
    manager_(dynamic_cast<TaskManager*>(&component)) {}

// -- of a managed component

const caf::actor& ComponentTasks::task_manager() const {
  auto& context = parts_.context;
  return context.neighbours().task_managers.at(context.identity().subarchitecture);
}

void ComponentTasks::propose(const TaskProposal& task) {
  ++parts_.context.counters().tasks_proposed;
  parts_.actor.send(task_manager(), ProposeTask{task});
}

void ComponentTasks::retract(const TaskId& id) {
  parts_.actor.send(task_manager(), RetractTask{id});
}

void ComponentTasks::complete(const TaskId& id, TaskOutcome outcome) {
  ++parts_.context.counters().tasks_completed;
  parts_.actor.send(task_manager(), CompleteTask{id, outcome});
}

// -- of a task manager

void ComponentTasks::decide(const TaskDecided& x) {
  auto i = proposers_.find(x.id);
  if (i == proposers_.end())
    return;
  parts_.actor.send(i->second, x);
  if (x.decision == TaskDecision::rejected)
    proposers_.erase(i);
}

void ComponentTasks::report(const TaskEvent& event) {
  if (auto& f = parts_.context.services().on_task)
    f(event);
}

// -- what arrives

bool ComponentTasks::handle(caf::mailbox_element& x) {
  return (managed_ && handle_managed(x)) || (manager_ && handle_manager(x));
}

bool ComponentTasks::handle_managed(caf::mailbox_element& x) {
  auto& content = x.content();
  if (!content.match_elements<TaskDecided>())
    return false;
  auto& decided = content.get_as<TaskDecided>(0);
  parts_.code.run("task " + decided.id, [&] {
    parts_.faults.in_callback();
    managed_->decided(decided);
  });
  return true;
}

bool ComponentTasks::handle_manager(caf::mailbox_element& x) {
  auto& content = x.content();
  auto& code = parts_.code;
  if (content.match_elements<ProposeTask>()) {
    auto& proposal = content.get_as<ProposeTask>(0).proposal;
    auto& proposer = proposers_[proposal.id] = caf::actor_cast<caf::actor>(x.sender);
    if (watched_.insert(proposer.address()).second)
      parts_.actor.monitor(proposer);
    code.run("the proposal of " + proposal.component, [&] { manager_->proposed(proposal); });
  } else if (content.match_elements<RetractTask>()) {
    auto& id = content.get_as<RetractTask>(0).id;
    proposers_.erase(id);
    code.run("the retraction of " + id, [&] { manager_->retracted(id); });
  } else if (content.match_elements<CompleteTask>()) {
    auto& done = content.get_as<CompleteTask>(0);
    proposers_.erase(done.id);
    code.run("the completion of " + done.id, [&] { manager_->completed(done.id, done.outcome); });
  } else if (content.match_elements<caf::down_msg>()) {
    handle_end(content.get_as<caf::down_msg>(0));
  } else {
    return false;
  }
  return true;
}

void ComponentTasks::handle_end(const caf::down_msg& x) {
  watched_.erase(x.source);
  std::vector<TaskId> left;
  for (auto& [id, proposer] : proposers_)
    if (proposer.address() == x.source)
      left.push_back(id);
  for (auto& id : left)
    proposers_.erase(id);
  parts_.code.run("the end of a component", [&] { manager_->abandoned(left, bool{x.reason}); });
}

void ComponentTasks::clear() {
  proposers_.clear();
  watched_.clear();
}

} // namespace castor
