#include "castor/mapping/localisation/localisation_monitor.hpp"

#include <fmt/format.h>

namespace castor::mapping {

namespace {

double seconds(std::int64_t microseconds) {
  return static_cast<double>(microseconds) / 1e6;
}

} // namespace

void LocalisationMonitor::begin_search(std::int64_t time) {
  search_began_ = time;
  way_ = 0;
  updates_ = 0;
}

LocalisationVerdict LocalisationMonitor::add(const LocalisationEvidence& x) {
  if (!has_begun_) {
    has_begun_ = true;
    missing_since_ = x.time;
    begin_search(x.time);
  }
  way_ += x.moved;
  updates_ += x.is_update ? 1 : 0;
  auto is_searching = state_ == LocalisationState::starting || state_ == LocalisationState::lost;
  auto result = is_searching ? search(x) : follow(x);
  state_ = result.state;
  return result;
}

bool LocalisationMonitor::is_found(const LocalisationEvidence& x) const {
  if (x.weight < options_.sure_weight || x.spread > options_.sure_spread || x.rivals > 0 ||
      x.many_rivals)
    return false;
  return (way_ >= options_.sure_way && x.explained >= options_.sure_explained) ||
         (updates_ >= options_.still_updates && x.explained >= options_.still_explained);
}

LocalisationVerdict LocalisationMonitor::search(const LocalisationEvidence& x) {
  if (is_found(x)) {
    fitted_ = x.time;
    return {LocalisationState::tracking,
            fmt::format("{} after {:.1f} s; the map explains {:.0f} % of the beams",
                        state_ == LocalisationState::lost ? "found again" : "found",
                        seconds(x.time - missing_since_), 100 * x.explained),
            false};
  }
  LocalisationVerdict result{state_, lost_reason_, false};
  auto is_narrow = x.weight >= options_.sure_weight && x.spread <= options_.sure_spread;
  if (is_narrow && x.explained < options_.least_explained && updates_ >= options_.still_updates &&
      seconds(x.time - search_began_) >= options_.lost_after) {
    // All particles are where the robot is not.
    begin_search(x.time);
    result.searches_anew = true;
  }
  auto found_so_far =
    x.many_rivals    ? std::string{"too many places look alike"}
    : x.rivals > 0   ? fmt::format("{} places look alike", x.rivals + 1)
    : x.clusters > 1 ? fmt::format("the robot may be in {} places, in the first with {:.0f} %",
                                   x.clusters, 100 * x.weight)
    : is_narrow      ? fmt::format("one place is left, which has to prove itself: the map explains "
                                        "{:.0f} % of the beams",
                                   100 * x.explained)
                     : fmt::format("the place is known to {:.1f} m", x.spread);
  result.reason = lost_reason_.empty() ? found_so_far : lost_reason_ + "; " + found_so_far;
  return result;
}

LocalisationVerdict LocalisationMonitor::follow(const LocalisationEvidence& x) {
  if (x.explained >= options_.least_explained) {
    fitted_ = x.time;
    if (x.weight >= options_.least_weight && x.spread <= options_.most_spread)
      return {LocalisationState::tracking, {}, false};
    return {LocalisationState::dead_reckoning,
            x.weight < options_.least_weight
              ? fmt::format("the robot may be in {} places", x.clusters)
              : fmt::format("the place is known to {:.1f} m only", x.spread),
            false};
  }
  auto reason = fmt::format("the map explains {:.0f} % of the beams", 100 * x.explained);
  if (seconds(x.time - fitted_) < options_.lost_after)
    return {LocalisationState::dead_reckoning, reason, false};
  lost_reason_ = fmt::format("lost: the map explained {:.0f} % of the beams, for {:.1f} s",
                             100 * x.explained, seconds(x.time - fitted_));
  missing_since_ = x.time;
  begin_search(x.time);
  return {LocalisationState::lost, lost_reason_, true};
}

} // namespace castor::mapping
