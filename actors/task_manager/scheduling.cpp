#include "castor/actors/component/registry.hpp"
#include "castor/actors/task_manager/task_schedule.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <optional>
#include <stdexcept>

namespace castor {

namespace {

/// Keeps what is under way within a budget of resources.
class SchedulingTaskManager final : public TaskManager {
  void configure() override {
    if (budget_ < 0)
      throw std::invalid_argument(
        fmt::format("--resource-budget is {}, but a budget is a number from 0", budget_.get()));
    schedule_.emplace(TaskSchedule::Rules{budget_, backfill_, remembered_});
  }

  void task_proposed(const TaskProposal& task) override { carry_out(schedule_->propose(task)); }

  void task_retracted(const TaskProposal& task) override { carry_out(schedule_->retract(task.id)); }

  void task_completed(const TaskProposal& task, TaskOutcome outcome) override {
    carry_out(schedule_->complete(task.id, outcome));
  }

  void carry_out(const TaskSchedule::Decisions& decisions) {
    for (auto& x : decisions)
      decide(x.id, x.decision, x.reason);
  }

  // Not --budget: every component has that, for its own computing.
  Option<double> budget_{this, "resource-budget", TaskSchedule::Rules{}.budget,
                         "what the adopted tasks may cost together"};
  Option<bool> backfill_{this, "backfill", TaskSchedule::Rules{}.backfill,
                         "let a task that fits overtake a more important one that does not"};
  Option<std::size_t> remembered_{this, "remembered", TaskSchedule::Rules{}.remembered,
                                  "of how many past tasks it knows how they ended"};
  std::optional<TaskSchedule> schedule_;
};

CASTOR_COMPONENT(SchedulingTaskManager,
                 "adopts tasks by priority, within a budget, after their predecessors")

} // namespace

} // namespace castor
