#include "castor/mapping/exploration/exploration_planner.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

void ExplorationPlanner::look(const CellMap& map, const Pose2& robot) {
  const FreeFloor floor(map, robot, options_.floor);
  frontiers_ = find_frontiers(map, floor, options_.frontiers);
  seen_ = floor.area();
}

std::optional<Frontier> ExplorationPlanner::choose() const {
  std::optional<Frontier> result;
  double best = 0;
  int fewest = options_.attempts;
  for (const auto& x : frontiers_) {
    if (!x.is_reachable || is_given_up(x))
      continue;
    const auto* before = attempts_at(x);
    const int count = before ? before->count : 0;
    const double worth = x.gain * std::exp(-options_.aversion * x.cost);
    // What was tried already comes last.
    if (!result || count < fewest || (count == fewest && worth > best)) {
      result = x;
      best = worth;
      fewest = count;
    }
  }
  return result;
}

bool ExplorationPlanner::is_open(const Frontier& x) const {
  return std::ranges::any_of(frontiers_, [&](const Frontier& y) {
    return y.is_reachable && distance(x.middle, y.middle) <= options_.same_within;
  });
}

std::vector<FrontierReport> ExplorationPlanner::report(const std::optional<Frontier>& goal) const {
  std::vector<FrontierReport> result;
  for (const auto& x : frontiers_) {
    FrontierReport y{x.middle.x, x.middle.y, x.size, FrontierState::open, x.reason};
    if (goal && distance(goal->middle, x.middle) <= options_.same_within) {
      y.state = FrontierState::chosen;
    } else if (!x.is_reachable) {
      y.state = FrontierState::unreachable;
    } else if (is_given_up(x)) {
      y.state = FrontierState::given_up;
      y.reason = attempts_at(x)->reason;
    }
    result.push_back(std::move(y));
  }
  return result;
}

void ExplorationPlanner::note(const Frontier& x, const std::string& reason) {
  for (auto& y : attempts_)
    if (distance(y.place, x.middle) <= options_.same_within) {
      ++y.count;
      y.reason = reason;
      return;
    }
  attempts_.push_back({x.middle, 1, reason});
}

const ExplorationPlanner::Attempts* ExplorationPlanner::attempts_at(const Frontier& x) const {
  const Attempts* result = nullptr;
  for (const auto& y : attempts_)
    if (distance(y.place, x.middle) <= options_.same_within && (!result || y.count > result->count))
      result = &y;
  return result;
}

bool ExplorationPlanner::is_given_up(const Frontier& x) const {
  const auto* before = attempts_at(x);
  return before && before->count >= options_.attempts;
}

} // namespace castor::mapping
