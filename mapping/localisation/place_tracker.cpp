#include "castor/mapping/localisation/place_tracker.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::mapping {

PlaceTracker::PlaceTracker(std::shared_ptr<const DistanceField> map, const MapFitOptions& fit,
                           const PlaceTrackerOptions& options)
  : options_(options), map_(std::move(map)), fit_(map_, fit), search_(map_, fit, options.search) {}

void PlaceTracker::restart() {
  trail_.clear();
  places_.clear();
  too_many_ = false;
  has_begun_ = false;
  way_since_trail_ = way_since_search_ = 0;
}

void PlaceTracker::follow(const LaserScan& scan, const Pose2& motion) {
  MapAlignmentOptions alignment;
  alignment.prior = options_.step_deviation;
  alignment.prior_heading = options_.step_deviation_heading;
  auto points = ends_of_beams(scan, options_.search.points);
  for (auto& x : places_) {
    x.pose = aligned(*map_, points, compose(x.pose, motion), alignment);
    x.explained += (fit_.explained(scan, x.pose) - x.explained) / options_.memory;
  }
  places_ =
    distinct_places(std::move(places_), options_.search.apart, options_.search.apart_heading);
  if (places_.empty())
    return;
  auto least = std::max(options_.least_explained, places_.front().explained - options_.margin);
  std::erase_if(places_, [&](const Place& x) { return x.explained < least; });
}

void PlaceTracker::search(std::int64_t time, const Pose2& odometry) {
  searched_ = time;
  way_since_search_ = 0;
  std::vector<PlacedScan> trail;
  trail.reserve(trail_.size());
  for (const auto& x : trail_)
    trail.push_back({x.scan, between(odometry, x.odometry)});
  auto found = search_.find(trail);
  if (found.places.empty() && !found.too_many && trail.size() > 1) {
    // No place explains them together: somebody may have carried the robot since the first.
    trail_.erase(trail_.begin(), trail_.end() - 1);
    found = search_.find({trail.back()});
  }
  places_ = std::move(found.places);
  too_many_ = found.too_many;
}

bool PlaceTracker::add(const LaserScan& scan, const Pose2& odometry) {
  auto is_first = !has_begun_;
  auto motion = is_first ? Pose2{} : between(odometry_, odometry);
  has_begun_ = true;
  odometry_ = odometry;
  auto way = std::hypot(motion.x, motion.y) + std::abs(motion.heading);
  way_since_trail_ += way;
  way_since_search_ += way;
  follow(scan, motion);
  auto is_overdue =
    places_.empty() && static_cast<double>(scan.time - searched_) >= 1e6 * options_.still_period;
  auto is_due =
    is_first || is_overdue ||
    way_since_search_ >= (places_.empty() ? options_.search_soon : options_.search_again);
  if (is_first || is_due || way_since_trail_ >= options_.trail_spacing) {
    way_since_trail_ = 0;
    trail_.push_back({scan, odometry});
    if (trail_.size() > options_.trail_length)
      trail_.pop_front();
  }
  if (is_due)
    search(scan.time, odometry);
  return is_due;
}

std::size_t PlaceTracker::rivals(const Pose2& pose) const {
  auto is_there = [&](const Place& x) {
    return distance(x.pose, pose) < 2 * options_.search.apart &&
           std::abs(normalised(x.pose.heading - pose.heading)) < 2 * options_.search.apart_heading;
  };
  return static_cast<std::size_t>(
    std::ranges::count_if(places_, [&](const Place& x) { return !is_there(x); }));
}

} // namespace castor::mapping
