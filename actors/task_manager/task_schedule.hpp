#pragma once

#include "castor/actors/component/task.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// Which of the proposed tasks are under way. It is told what happened and returns what that
/// decides, in this order: rejections, adoptions, and that the proposed task has to wait.
///
/// - A task is ready once all its predecessors have succeeded. If one of them ends in any other
///   way, the task is rejected, and so are those that come after it. A predecessor that nobody has
///   proposed so far is waited for; a cycle of predecessors is rejected when it closes.
/// - Among ready tasks the one of highest priority comes first, then the oldest. It is adopted when
///   its cost fits into what the adopted tasks leave of the budget; until then none that comes
///   behind it is adopted either, so that small tasks cannot starve a large one. With `backfill`
///   they are adopted, and can.
/// - A task that costs more than the whole budget is rejected.
class TaskSchedule {
public:
  struct Rules {
    /// What the adopted tasks may cost together. Met up to a relative rounding error of 1e-9, so
    /// that ten tasks of 0.1 fit into 1.
    double budget = 1;
    /// Whether a task that fits may overtake one that does not.
    bool backfill = false;
    /// Of how many tasks that are over it is known how they ended. A task that comes after one that
    /// was forgotten waits as if nobody had proposed that one.
    std::size_t remembered = 10'000;
  };

  using Decisions = std::vector<TaskDecided>;

  explicit TaskSchedule(Rules rules) : rules_(rules) {}

  /// Decides on the task: adopted, waiting or rejected. One under way by the same id is retracted.
  Decisions propose(const TaskProposal& task);

  /// Unknown ids are ignored, here and in `complete`.
  Decisions retract(const TaskId& id);
  Decisions complete(const TaskId& id, TaskOutcome outcome);

  /// What the adopted tasks cost together.
  double used() const;

private:
  /// How a task ended.
  enum class End : std::uint8_t { success, failure, incomplete, rejected, retracted };

  struct Task {
    TaskOptions options;
    /// Counts proposals.
    std::uint64_t number = 0;
    /// Predecessors that have not succeeded so far.
    std::set<TaskId> awaited;
  };

  /// Orders ready tasks: priority, negated, and number.
  using Place = std::pair<std::int64_t, std::uint64_t>;

  static Place place_of(const Task& x) { return {-std::int64_t{x.options.priority}, x.number}; }
  static std::string to_string(End x);

  /// What forbids the task for good; empty if nothing does.
  std::string objection(const TaskProposal& task) const;
  /// "a waits for b, which waits for a", should the task close a cycle; otherwise empty.
  std::string cycle_through(const TaskProposal& task) const;
  std::string why_waiting(const TaskId& id) const;
  bool fits(double cost, double used) const;

  void end(const TaskId& id, End how, Decisions& out);
  void take_out(const TaskId& id);
  void remember(const TaskId& id, End how);
  void adopt_what_fits(Decisions& out);

  Rules rules_;
  std::uint64_t proposals_ = 0;
  /// Adopted and waiting ones.
  std::unordered_map<TaskId, Task> tasks_;
  /// What each adopted task costs.
  std::map<TaskId, double> running_;
  std::map<Place, TaskId> ready_;
  /// By predecessor, the tasks that await it, oldest first.
  std::unordered_map<TaskId, std::vector<TaskId>> dependants_;
  std::unordered_map<TaskId, End> ended_;
  /// The keys of `ended_`, longest ago first.
  std::deque<TaskId> ended_order_;
};

} // namespace castor
