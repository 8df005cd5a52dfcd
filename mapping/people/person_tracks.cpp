#include "castor/mapping/people/person_tracks.hpp"

#include "castor/mapping/people/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace castor::mapping {

namespace {

/// Of somebody new, m/s: people walk up to some 1.5 m/s.
constexpr double first_speed = 0.8;
/// Slower people have no direction of walking, m/s.
constexpr double walking = 0.2;
/// Each scan's share in the visibility.
constexpr double visibility_share = 0.1;
/// Somebody out of sight slows down, 1/s: nobody walks on for ever.
constexpr double slowing = 0.3;

double seconds(std::int64_t microseconds) {
  return static_cast<double>(microseconds) * 1e-6;
}

} // namespace

void PersonTracks::predict(Followed& x, double dt) const {
  auto& track = x.track;
  track.place.x += track.velocity.x * dt;
  track.place.y += track.velocity.y * dt;
  // White noise of the acceleration (Bar-Shalom et al. 2001, section 6.2.2).
  const double q = options_.acceleration * options_.acceleration;
  x.place_variance += 2 * dt * x.covariance + dt * dt * x.velocity_variance + q * dt * dt * dt / 3;
  x.covariance += dt * x.velocity_variance + q * dt * dt / 2;
  x.velocity_variance += q * dt;
}

void PersonTracks::correct(Followed& x, const Point2& detection) {
  auto& track = x.track;
  const double sum = x.place_variance + options_.noise * options_.noise;
  const double gain = x.place_variance / sum;
  const double velocity_gain = x.covariance / sum;
  const Point2 off{detection.x - track.place.x, detection.y - track.place.y};
  track.place.x += gain * off.x;
  track.place.y += gain * off.y;
  track.velocity.x += velocity_gain * off.x;
  track.velocity.y += velocity_gain * off.y;
  x.velocity_variance -= velocity_gain * x.covariance;
  x.covariance *= 1 - gain;
  x.place_variance *= 1 - gain;
  ++x.detections;
  x.unseen = 0;
  if (track.speed() > walking)
    track.heading = std::atan2(track.velocity.y, track.velocity.x);
  if (!track.is_person && x.detections >= options_.confirming &&
      distance(x.first_place, track.place) >= options_.confirming_way &&
      track.speed() >= options_.confirming_speed) {
    track.is_person = true;
    track.id = next_id_++;
  }
}

void PersonTracks::begin(const Point2& detection) {
  Followed x;
  x.track.place = x.first_place = detection;
  x.track.visibility = 0.5;
  x.place_variance = options_.noise * options_.noise;
  x.velocity_variance = first_speed * first_speed;
  followed_.push_back(x);
}

void PersonTracks::add(std::span<const Point2> detections, std::int64_t time) {
  const double dt = std::max(0.0, seconds(time - time_));
  time_ = time;
  CostMatrix costs;
  for (auto& x : followed_) {
    predict(x, dt);
    auto& row = costs.emplace_back();
    const double deviation = std::sqrt(x.place_variance + options_.noise * options_.noise);
    for (const auto& detection : detections) {
      const double off = distance(x.track.place, detection);
      constexpr double never = std::numeric_limits<double>::infinity();
      // Known people come before those who may be things.
      const double doubt = x.track.is_person ? 0 : 1;
      // The negative logarithm of the likelihood, up to what all have in common.
      const double cost =
        off * off / (2 * deviation * deviation) + 2 * std::log1p(deviation) + doubt;
      row.push_back(off > options_.farthest || off > options_.gate * deviation ? never : cost);
    }
  }
  const auto assigned = assign(costs);
  std::vector<bool> used(detections.size());
  for (std::size_t i = 0; i < followed_.size(); ++i) {
    auto& x = followed_[i];
    const double seen = assigned[i] ? 1 : 0;
    x.track.visibility += visibility_share * (seen - x.track.visibility);
    if (assigned[i]) {
      used[*assigned[i]] = true;
      correct(x, detections[*assigned[i]]);
    } else {
      x.unseen += dt;
      x.track.velocity.x *= std::exp(-slowing * dt);
      x.track.velocity.y *= std::exp(-slowing * dt);
    }
  }
  const auto known = followed_.size();
  for (std::size_t i = 0; i < detections.size(); ++i) {
    const auto is_near = [&](const Followed& x) {
      return x.unseen == 0 && distance(x.track.place, detections[i]) < options_.apart;
    };
    if (!used[i] && std::none_of(followed_.begin(),
                                 followed_.begin() + static_cast<std::ptrdiff_t>(known), is_near))
      begin(detections[i]);
  }
  std::erase_if(followed_, [&](const Followed& x) {
    return x.unseen > (x.track.is_person ? options_.patience : options_.early_patience);
  });
}

std::vector<Point2> PersonTracks::expected(std::int64_t time) const {
  const double dt = std::max(0.0, seconds(time - time_));
  std::vector<Point2> result;
  for (const auto& x : followed_)
    if (x.track.is_person)
      result.push_back(
        {x.track.place.x + x.track.velocity.x * dt, x.track.place.y + x.track.velocity.y * dt});
  return result;
}

std::vector<PersonTracks::Track> PersonTracks::people() const {
  std::vector<Track> result;
  for (const auto& x : followed_)
    if (x.track.is_person)
      result.push_back(x.track);
  return result;
}

} // namespace castor::mapping
