#pragma once

#include "castor/mapping/movement/reachable_cells.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace castor::mapping {

/// What a check that shares nothing with the planner says of a goal. `doubtful`: it depends on a
/// cell more or less.
enum class Reachability { reachable, doubtful, unreachable };

/// By ReachableCells with a cell more clearance than needed, and with a cell less.
class ReachabilityCheck {
public:
  /// @param sure_clearance where what is no disc fits however it faces, metres; nothing: a disc
  ReachabilityCheck(const CellMap& map, const Point2& start, double clearance,
                    std::optional<double> sure_clearance = {});

  Reachability of(const Point2& goal) const;

private:
  ReachableCells surely_;
  ReachableCells perhaps_;
};

/// How the way to a goal went.
struct GoalOutcome {
  bool is_reached = false;
  /// Nothing if there is no map to check it with.
  std::optional<Reachability> reachability;
  /// Way driven, and the shortest one with that clearance; metres. Nothing if there is none.
  double driven = 0;
  std::optional<double> shortest;
  /// Seconds that it stood because something was in its way.
  double waited = 0;
  std::int64_t recoveries = 0;
  std::int64_t collisions = 0;
};

/// Sums up goals of one kind.
class GoalTally {
public:
  void add(const GoalOutcome& x);
  /// Seconds.
  void add_plan(double time) { planning_times_.push_back(time); }

  std::size_t goals() const { return goals_; }
  std::size_t reached() const { return reached_; }
  /// Refused, and the check agrees; refused where the check says that it can be reached.
  std::size_t honestly_refused() const { return honestly_refused_; }
  std::size_t wrongly_refused() const { return wrongly_refused_; }
  std::int64_t collisions() const { return collisions_; }

  /// One line, for people.
  std::string text() const;

private:
  std::size_t goals_ = 0;
  std::size_t reached_ = 0;
  std::size_t honestly_refused_ = 0;
  std::size_t wrongly_refused_ = 0;
  std::size_t other_refused_ = 0;
  double driven_ = 0;
  std::int64_t recoveries_ = 0;
  std::int64_t collisions_ = 0;
  std::vector<double> waits_;
  /// Ways driven by the shortest ones, of goals that are further than a metre.
  std::vector<double> ratios_;
  std::vector<double> planning_times_;
};

} // namespace castor::mapping
