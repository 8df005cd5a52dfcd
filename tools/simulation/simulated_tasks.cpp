#include "castor/tools/simulation/simulated_tasks.hpp"

#include <algorithm>
#include <utility>

namespace castor::simulation {

namespace {

/// TaskSchedule meets its budget up to a rounding error.
constexpr double tolerance = 1 + 1e-9;

} // namespace

// -- ledger

void TaskLedger::proposed(const TaskProposal& task, const ComponentLife& by) {
  happened_.add("tasks", "proposed");
  Task x;
  x.proposal = task;
  x.proposer = by;
  tasks_.insert_or_assign(task.id, std::move(x));
}

void TaskLedger::retracted(const TaskId& id) {
  happened_.add("tasks", "retracted");
  tasks_.at(id).state = State::retracted;
}

void TaskLedger::completed(const TaskId& id, TaskOutcome outcome) {
  happened_.add("tasks", outcome == TaskOutcome::success ? "succeeded" : "not succeeded");
  auto& task = tasks_.at(id);
  task.state = State::completed;
  task.outcome = outcome;
}

void TaskLedger::ended(const std::string& component, std::uint64_t incarnation) {
  for (auto& [id, task] : tasks_)
    if (task.proposer.component == component && task.proposer.incarnation == incarnation) {
      if (task.proposer_lives && task.state == State::adopted)
        happened_.add("tasks", "abandoned");
      task.proposer_lives = false;
    }
}

void TaskLedger::received(const TaskId& id, const ComponentLife& manager) {
  if (auto i = tasks_.find(id); i != tasks_.end()) {
    i->second.is_received = true;
    i->second.manager = manager;
  }
}

bool TaskLedger::succeeded(const TaskId& id) const {
  auto i = tasks_.find(id);
  return i != tasks_.end() && i->second.state == State::completed &&
         i->second.outcome == TaskOutcome::success;
}

std::string TaskLedger::decided(const TaskDecided& x, const ComponentLife& manager, double budget) {
  auto i = tasks_.find(x.id);
  if (i == tasks_.end())
    return "decides on " + x.id + ", which nobody proposed";
  auto& task = i->second;
  auto is_open = task.state == State::proposed || task.state == State::waiting;
  switch (x.decision) {
    case TaskDecision::waiting:
      happened_.add("tasks", "waiting");
      if (is_open)
        task.state = State::waiting;
      return {};
    case TaskDecision::rejected:
      happened_.add("tasks", "rejected");
      if (is_open)
        task.state = State::rejected;
      return {};
    case TaskDecision::adopted:
      break;
  }
  happened_.add("tasks", "adopted");
  if (is_open)
    task.state = State::adopted;
  else if (task.state != State::retracted)
    return "adopts " + x.id + ", which is over";
  for (auto& predecessor : task.proposal.options.after)
    if (!succeeded(predecessor))
      return "adopts " + x.id + ", which comes after " + predecessor +
             ", and that has not succeeded";
  double cost = 0;
  for (auto& [id, other] : tasks_)
    if (other.state == State::adopted && other.proposer_lives && other.manager == manager &&
        !have_lost_(manager.process, other.proposer.process))
      cost += other.proposal.options.cost;
  if (cost > budget * tolerance)
    return "adopts " + x.id + ", with which the tasks under way cost " + std::to_string(cost) +
           " of " + std::to_string(budget);
  return {};
}

std::vector<std::string> TaskLedger::overlooked(const std::vector<ComponentLife>& managers,
                                                double budget) const {
  std::vector<std::string> result;
  for (auto& [id, task] : tasks_) {
    if (!task.proposer_lives || !task.is_received ||
        (task.state != State::proposed && task.state != State::waiting) ||
        std::ranges::find(managers, task.manager) == managers.end() ||
        have_lost_(task.manager.process, task.proposer.process))
      continue;
    if (task.state == State::proposed)
      result.push_back("nothing was decided on " + id);
    else if (task.proposal.options.cost <= budget &&
             std::ranges::all_of(task.proposal.options.after, [&](auto& predecessor) {
               auto i = tasks_.find(predecessor);
               return i != tasks_.end() && succeeded(predecessor) &&
                      i->second.manager == task.manager;
             }))
      result.push_back(id + " waits, and nothing is in its way");
  }
  return result;
}

// -- manager

void SimulatedTaskManager::propose(const TaskProposal& task, const caf::actor& proposer) {
  proposers_[task.id] = proposer;
  carry_out(schedule_.propose(task));
}

void SimulatedTaskManager::retract(const TaskId& id) {
  if (proposers_.erase(id) > 0)
    carry_out(schedule_.retract(id));
}

void SimulatedTaskManager::complete(const TaskId& id, TaskOutcome outcome) {
  if (proposers_.erase(id) > 0)
    carry_out(schedule_.complete(id, outcome));
}

void SimulatedTaskManager::abandoned(const caf::actor_addr& proposer) {
  std::vector<TaskId> left;
  std::erase_if(proposers_, [&](auto& x) {
    if (x.second.address() != proposer)
      return false;
    left.push_back(x.first);
    return true;
  });
  for (auto& id : left)
    carry_out(schedule_.retract(id));
}

void SimulatedTaskManager::carry_out(const TaskSchedule::Decisions& decisions) {
  for (auto& x : decisions) {
    auto i = proposers_.find(x.id);
    if (i == proposers_.end())
      continue;
    tell_(i->second, x);
    if (x.decision == TaskDecision::rejected)
      proposers_.erase(i);
  }
}

} // namespace castor::simulation
