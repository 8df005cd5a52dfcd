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

/// Decides which proposed tasks are adopted. Each function takes an event and returns the resulting
/// decisions, in this order: rejections, adoptions, and that the proposed task has to wait.
///
/// - A task is ready once all its predecessors have succeeded. If one of them ends in any other
///   way, the task is rejected, and so are those that depend on it. A predecessor that was not
///   proposed so far is waited for; a task that closes a cycle of predecessors is rejected.
/// - Among ready tasks the one of highest priority comes first, then the oldest. It is adopted when
///   its cost fits into the rest of the budget; until then none behind it is adopted either, so
///   that small tasks cannot starve a large one. With `backfill` they are adopted, and can starve
///   it.
/// - A task that costs more than the whole budget is rejected.
class TaskSchedule {
public:
  struct Rules {
    /// Highest total cost of the adopted tasks. Met up to a relative rounding error of 1e-9, so
    /// that ten tasks of 0.1 fit into 1.
    double budget = 1;
    /// Whether a task that fits may overtake one that does not.
    bool backfill = false;
    /// Number of ended tasks whose outcome is remembered. A forgotten predecessor counts as not
    /// proposed so far.
    std::size_t remembered = 10'000;
  };

  using Decisions = std::vector<TaskDecided>;

  explicit TaskSchedule(Rules rules) : rules_(rules) {}

  /// Decides on the task: adopted, waiting or rejected. An earlier task of the same id that has not
  /// ended is retracted.
  Decisions propose(const TaskProposal& task);

  /// Unknown ids are ignored, here and in `complete`.
  Decisions retract(const TaskId& id);
  Decisions complete(const TaskId& id, TaskOutcome outcome);

  /// Total cost of the adopted tasks.
  double used() const;

private:
  /// How a task ended.
  enum class End : std::uint8_t { success, failure, incomplete, rejected, retracted };

  struct Task {
    TaskOptions options;
    /// Sequence number of the proposal.
    std::uint64_t number = 0;
    /// Predecessors that have not succeeded so far.
    std::set<TaskId> awaited;
  };

  /// Orders ready tasks: priority, negated, and number.
  using Place = std::pair<std::int64_t, std::uint64_t>;

  static Place place_of(const Task& x) { return {-std::int64_t{x.options.priority}, x.number}; }
  static std::string to_string(End x);

  /// Reason to reject the task; empty if there is none.
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
  /// Adopted and waiting tasks.
  std::unordered_map<TaskId, Task> tasks_;
  /// Cost of each adopted task.
  std::map<TaskId, double> running_;
  std::map<Place, TaskId> ready_;
  /// By predecessor, the tasks that await it, oldest first.
  std::unordered_map<TaskId, std::vector<TaskId>> dependants_;
  std::unordered_map<TaskId, End> ended_;
  /// The keys of `ended_`, longest ago first.
  std::deque<TaskId> ended_order_;
};

} // namespace castor
