#include "castor/mapping/localisation/monte_carlo_localiser.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

/// m plus radians.
double size_of(const Pose2& motion) {
  return std::hypot(motion.x, motion.y) + std::abs(motion.heading);
}

} // namespace

MonteCarloLocaliser::MonteCarloLocaliser(const CellMap& map, const std::optional<Pose2>& start,
                                         const MonteCarloOptions& options)
  : options_(options),
    map_(std::make_shared<const DistanceField>(map, options.filter.occupied_from)),
    fit_(map_, options.fit), filter_(map, options.filter),
    places_(map_, options.fit, options.places), monitor_(options.monitor), is_anywhere_(!start) {
  if (!start)
    return;
  filter_.spread_around({*start}, options.start_deviation, options.start_deviation_heading);
  is_spread_ = true;
}

bool MonteCarloLocaliser::is_searching() const {
  return monitor_.state() == LocalisationState::starting ||
         monitor_.state() == LocalisationState::lost;
}

void MonteCarloLocaliser::search_everywhere() {
  places_.restart();
  is_anywhere_ = true;
  is_spread_ = false;
  still_updates_ = 0;
  updated_ = 0;
}

void MonteCarloLocaliser::update(const LaserScan& scan, const Pose2& odometry,
                                 const Pose2& motion) {
  auto moved = motion;
  if (is_searching() && is_anywhere_) {
    auto was_searched = places_.add(scan, odometry);
    const auto& places = places_.places();
    // One place is left, and the particles are at another.
    auto is_elsewhere = places.size() == 1 && is_spread_ && places_.rivals(best_.mean) == 1;
    if (!places.empty() && (was_searched || is_elsewhere)) {
      std::vector<Pose2> poses;
      for (const auto& x : places)
        poses.push_back(x.pose);
      filter_.spread_around(poses, options_.start_deviation / 2,
                            options_.start_deviation_heading / 2);
      moved = {};
    } else if (!is_spread_) {
      auto wanted = std::lround(options_.search_density * map_->free_area());
      filter_.spread_everywhere(static_cast<unsigned>(
        std::clamp<long>(wanted, options_.filter.least_particles, options_.filter.most_particles)));
      moved = {};
    }
    is_spread_ = true;
  }
  filter_.update(moved, scan);
  summarise();
}

bool MonteCarloLocaliser::is_due(std::int64_t time, const Pose2& motion) {
  if (!has_begun_)
    return true;
  if (std::hypot(motion.x, motion.y) >= options_.update_distance ||
      std::abs(motion.heading) >= options_.update_turn) {
    still_updates_ = 0;
    return true;
  }
  if (!is_searching())
    return false;
  auto period =
    still_updates_ < options_.still_updates ? options_.still_period : options_.places.still_period;
  if (static_cast<double>(time - updated_) < 1e6 * period)
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
    update(scan, odometry, motion);
    update_odometry_ = odometry;
    updated_ = scan.time;
  }
  has_begun_ = true;
  last_odometry_ = odometry;
  LocalisationStep result;
  result.time = scan.time;
  result.pose = compose(best_.mean, between(update_odometry_, odometry));
  result.explained = fit_.explained(scan, result.pose);
  auto better =
    aligned(*map_, ends_of_beams(scan, options_.alignment_beams), result.pose, options_.alignment);
  auto explained = fit_.explained(scan, better);
  if (explained >= result.explained) {
    result.pose = better;
    result.explained = explained;
  }
  result.covariance = best_.covariance;
  result.spread = best_.spread();
  result.clusters = clusters_;
  result.weight = best_.weight;
  result.particles = particles_;
  if (is_searching() && is_anywhere_) {
    result.rivals = places_.rivals(result.pose);
    // The place of the particles is none that explains the scans.
    evidence.many_rivals = places_.places().empty();
  }
  evidence.clusters = result.clusters;
  evidence.weight = result.weight;
  evidence.rivals = result.rivals;
  evidence.spread = result.spread;
  evidence.explained = result.explained;
  auto verdict = monitor_.add(evidence);
  if (verdict.searches_anew)
    search_everywhere();
  if (verdict.state == LocalisationState::tracking)
    is_anywhere_ = false;
  result.state = verdict.state;
  result.reason = std::move(verdict.reason);
  return result;
}

} // namespace castor::mapping
