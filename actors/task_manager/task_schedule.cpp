#include "castor/actors/task_manager/task_schedule.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace castor {

TaskSchedule::Decisions TaskSchedule::propose(const TaskProposal& task) {
  auto& id = task.id;
  Decisions out;
  if (tasks_.count(id) > 0)
    end(id, End::retracted, out);
  if (ended_.erase(id) > 0)
    std::erase(ended_order_, id);
  if (auto why = objection(task); !why.empty()) {
    out.push_back({id, TaskDecision::rejected, std::move(why)});
    end(id, End::rejected, out);
    adopt_what_fits(out);
    return out;
  }
  auto& added = tasks_[id];
  added.options = task.options;
  added.number = ++proposals_;
  for (auto& x : task.options.after)
    if (ended_.count(x) == 0 && added.awaited.insert(x).second)
      dependants_[x].push_back(id);
  if (added.awaited.empty())
    ready_.emplace(place_of(added), id);
  adopt_what_fits(out);
  if (running_.count(id) == 0)
    out.push_back({id, TaskDecision::waiting, why_waiting(id)});
  return out;
}

TaskSchedule::Decisions TaskSchedule::retract(const TaskId& id) {
  Decisions out;
  if (tasks_.count(id) > 0) {
    end(id, End::retracted, out);
    adopt_what_fits(out);
  }
  return out;
}

TaskSchedule::Decisions TaskSchedule::complete(const TaskId& id, TaskOutcome outcome) {
  Decisions out;
  if (tasks_.count(id) > 0) {
    end(id,
        outcome == TaskOutcome::success   ? End::success
        : outcome == TaskOutcome::failure ? End::failure
                                          : End::incomplete,
        out);
    adopt_what_fits(out);
  }
  return out;
}

double TaskSchedule::used() const {
  // Summed up each time: a running balance would gather rounding errors.
  double result = 0;
  for (auto& [id, cost] : running_)
    result += cost;
  return result;
}

std::string TaskSchedule::to_string(End x) {
  switch (x) {
    case End::success:
      return "succeeded";
    case End::failure:
      return "failed";
    case End::incomplete:
      return "was left incomplete";
    case End::rejected:
      return "was rejected";
    case End::retracted:
      return "was retracted";
  }
  return {};
}

std::string TaskSchedule::objection(const TaskProposal& task) const {
  auto cost = task.options.cost;
  if (!std::isfinite(cost) || cost < 0)
    return fmt::format("its cost is {}, but a cost is a number from 0", cost);
  if (!fits(cost, 0))
    return fmt::format("it costs {:.6g}, more than the whole budget of {:.6g}", cost,
                       rules_.budget);
  for (auto& x : task.options.after)
    if (auto i = ended_.find(x); i != ended_.end() && i->second != End::success)
      return fmt::format("its predecessor {} {}", x, to_string(i->second));
  if (auto cycle = cycle_through(task); !cycle.empty())
    return "its predecessors form a cycle: " + cycle;
  return {};
}

std::string TaskSchedule::cycle_through(const TaskProposal& task) const {
  auto& after = task.options.after;
  // From those that await the task to those that await them: usually there are none.
  std::map<TaskId, TaskId> awaits{{task.id, {}}};
  std::deque<TaskId> open{task.id};
  for (; !open.empty(); open.pop_front()) {
    auto& x = open.front();
    if (std::find(after.begin(), after.end(), x) != after.end()) {
      auto result = fmt::format("{} waits for {}", task.id, x);
      for (auto y = x; y != task.id; y = awaits.at(y))
        result += fmt::format(", which waits for {}", awaits.at(y));
      return result;
    }
    if (auto i = dependants_.find(x); i != dependants_.end())
      for (auto& y : i->second)
        if (awaits.emplace(y, x).second)
          open.push_back(y);
  }
  return {};
}

std::string TaskSchedule::why_waiting(const TaskId& id) const {
  auto& task = tasks_.at(id);
  if (!task.awaited.empty()) {
    std::string result = "it waits for ";
    for (auto& x : task.awaited)
      result += (x == *task.awaited.begin() ? "" : ", ") + x +
                (tasks_.count(x) == 0 ? " (not proposed so far)" : "");
    return result;
  }
  if (auto& first = ready_.begin()->second; !rules_.backfill && first != id)
    return first + " comes first";
  return fmt::format("it costs {:.6g}, and {:.6g} of the budget of {:.6g} is taken",
                     task.options.cost, used(), rules_.budget);
}

bool TaskSchedule::fits(double cost, double used) const {
  return used + cost <= rules_.budget * (1 + 1e-9);
}

void TaskSchedule::end(const TaskId& id, End how, Decisions& out) {
  const auto cause = fmt::format("{} {}", id, to_string(how));
  take_out(id);
  remember(id, how);
  // The task, and then those that are rejected because of it.
  std::deque<TaskId> over{id};
  for (; !over.empty(); over.pop_front()) {
    auto& x = over.front();
    auto dependants = dependants_.extract(x);
    if (!dependants)
      continue;
    for (auto& y : dependants.mapped()) {
      auto& task = tasks_.at(y);
      task.awaited.erase(x);
      if (how != End::success) {
        out.push_back({y, TaskDecision::rejected,
                       "its predecessor " +
                         (x == id ? cause : fmt::format("{} was rejected, since {}", x, cause))});
        take_out(y);
        remember(y, End::rejected);
        over.push_back(y);
      } else if (task.awaited.empty()) {
        ready_.emplace(place_of(task), y);
      }
    }
  }
}

void TaskSchedule::take_out(const TaskId& id) {
  auto i = tasks_.find(id);
  if (i == tasks_.end())
    return;
  running_.erase(id);
  ready_.erase(place_of(i->second));
  for (auto& x : i->second.awaited) {
    auto awaiting = dependants_.find(x);
    std::erase(awaiting->second, id);
    if (awaiting->second.empty())
      dependants_.erase(awaiting);
  }
  tasks_.erase(i);
}

void TaskSchedule::remember(const TaskId& id, End how) {
  ended_.emplace(id, how);
  ended_order_.push_back(id);
  if (ended_order_.size() > rules_.remembered) {
    ended_.erase(ended_order_.front());
    ended_order_.pop_front();
  }
}

void TaskSchedule::adopt_what_fits(Decisions& out) {
  auto taken = used();
  for (auto i = ready_.begin(); i != ready_.end();) {
    auto& id = i->second;
    auto cost = tasks_.at(id).options.cost;
    if (fits(cost, taken)) {
      taken += cost;
      running_.emplace(id, cost);
      out.push_back({id, TaskDecision::adopted, {}});
      i = ready_.erase(i);
    } else if (rules_.backfill) {
      ++i;
    } else {
      return;
    }
  }
}

} // namespace castor
