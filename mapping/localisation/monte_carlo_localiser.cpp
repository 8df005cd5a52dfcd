#include "castor/mapping/localisation/monte_carlo_localiser.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::mapping {

namespace {

/// m plus radians.
double size_of(const Pose2& motion) {
  return std::hypot(motion.x, motion.y) + std::abs(motion.heading);
}

} // namespace

MonteCarloLocaliser::MonteCarloLocaliser(const CellMap& map, const std::optional<Pose2>& start,
                                         const MonteCarloOptions& options)
  : options_(options), fit_(map, options.fit), filter_(map, options.filter),
    monitor_(options.monitor) {
  if (start)
    filter_.spread_around(*start, options.start_deviation, options.start_deviation_heading);
  else
    search_everywhere();
}

void MonteCarloLocaliser::search_everywhere() {
  auto wanted = std::lround(options_.search_density * fit_.free_area());
  filter_.spread_everywhere(static_cast<unsigned>(
    std::clamp<long>(wanted, options_.filter.least_particles, options_.filter.most_particles)));
  still_updates_ = 0;
  updated_ = 0;
}

bool MonteCarloLocaliser::is_due(std::int64_t time, const Pose2& motion) {
  if (!has_begun_)
    return true;
  if (std::hypot(motion.x, motion.y) >= options_.update_distance ||
      std::abs(motion.heading) >= options_.update_turn) {
    still_updates_ = 0;
    return true;
  }
  auto state = monitor_.state();
  auto is_searching = state == LocalisationState::starting || state == LocalisationState::lost;
  if (!is_searching || still_updates_ >= options_.still_updates ||
      static_cast<double>(time - updated_) < 1e6 * options_.still_period)
    return false;
  ++still_updates_;
  return true;
}

void MonteCarloLocaliser::summarise() {
  auto particles = filter_.particles();
  particles_ = particles.size();
  auto clusters = clusters_of(particles, options_.clusters);
  clusters_ = clusters.size();
  best_ = clusters.front();
}

LocalisationStep MonteCarloLocaliser::add(const LaserScan& scan, const Pose2& odometry) {
  if (!has_begun_)
    last_odometry_ = update_odometry_ = odometry;
  auto motion = between(update_odometry_, odometry);
  LocalisationEvidence evidence;
  evidence.time = scan.time;
  evidence.moved = size_of(between(last_odometry_, odometry));
  evidence.is_update = is_due(scan.time, motion);
  if (evidence.is_update) {
    filter_.update(motion, scan);
    update_odometry_ = odometry;
    updated_ = scan.time;
    summarise();
  }
  has_begun_ = true;
  last_odometry_ = odometry;
  LocalisationStep result;
  result.time = scan.time;
  result.pose = compose(best_.mean, between(update_odometry_, odometry));
  result.covariance = best_.covariance;
  result.spread = best_.spread();
  result.explained = fit_.explained(scan, result.pose);
  result.clusters = evidence.clusters = clusters_;
  result.weight = evidence.weight = best_.weight;
  result.particles = particles_;
  evidence.spread = result.spread;
  evidence.explained = result.explained;
  auto verdict = monitor_.add(evidence);
  if (verdict.searches_anew)
    search_everywhere();
  result.state = verdict.state;
  result.reason = std::move(verdict.reason);
  return result;
}

} // namespace castor::mapping
