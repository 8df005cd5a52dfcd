#include "castor/mapping/movement/goal_tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace castor::mapping {

namespace {

double quantile(std::vector<double> values, double share) {
  if (values.empty())
    return 0;
  std::ranges::sort(values);
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(share * last))];
}

} // namespace

ReachabilityCheck::ReachabilityCheck(const CellMap& map, const Point2& start, double clearance,
                                     std::optional<double> sure_clearance)
  : surely_(map, start, sure_clearance.value_or(clearance) + map.cell_size),
    perhaps_(map, start, clearance - map.cell_size) {
  // nop
}

Reachability ReachabilityCheck::of(const Point2& goal) const {
  if (surely_.can_be_at(goal))
    return Reachability::reachable;
  return perhaps_.can_be_at(goal) ? Reachability::doubtful : Reachability::unreachable;
}

void GoalTally::add(const GoalOutcome& x) {
  ++goals_;
  driven_ += x.driven;
  recoveries_ += x.recoveries;
  collisions_ += x.collisions;
  waits_.push_back(x.waited);
  if (x.is_reached) {
    ++reached_;
    constexpr double least = 1; // metres
    if (x.shortest && *x.shortest > least)
      ratios_.push_back(x.driven / *x.shortest);
  } else if (x.reachability == Reachability::unreachable) {
    ++honestly_refused_;
  } else if (x.reachability == Reachability::reachable) {
    ++wrongly_refused_;
  } else {
    ++other_refused_;
  }
}

std::string GoalTally::text() const {
  return fmt::format(
    "{} goals: {} reached, {} refused honestly, {} wrongly, {} in doubt; {} collisions; {:.1f} m "
    "driven, {:.3f} of the shortest (median; p95 {:.3f}); stood {:.1f} s ({:.1f} s for a goal at "
    "p95); {} recoveries; a plan took {:.1f} ms (p50), {:.1f} ms (p95) of {}",
    goals_, reached_, honestly_refused_, wrongly_refused_, other_refused_, collisions_, driven_,
    quantile(ratios_, 0.5), quantile(ratios_, 0.95),
    std::accumulate(waits_.begin(), waits_.end(), 0.0), quantile(waits_, 0.95), recoveries_,
    1000 * quantile(planning_times_, 0.5), 1000 * quantile(planning_times_, 0.95),
    planning_times_.size());
}

} // namespace castor::mapping
