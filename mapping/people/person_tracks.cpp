#include "castor/mapping/people/person_tracks.hpp"

#include "castor/mapping/people/joint_assignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace castor::mapping {

namespace {

/// Of somebody new, m/s: people walk up to some 1.5 m/s.
constexpr double first_speed = 0.8;
/// Slower people have no direction of walking, m/s.
constexpr double walking = 0.2;
/// Each scan's share in the visibility.
constexpr double visibility_share = 0.1;
/// Somebody out of sight for so long, seconds, slows down, 1/s: nobody walks on for ever.
constexpr double walks_on = 1.5;
constexpr double slowing = 1;
/// Of the variance of a measurement, for the steady motion: errors of legs last for half a step.
constexpr double steady_noise = 2;
/// Known people come before those who may be things: cost of each part of the latter.
constexpr double doubt = 1.5;
/// Nobody is there if so many beams pass.
constexpr double absent_share = 0.8;

double seconds(std::int64_t microseconds) {
  return static_cast<double>(microseconds) * 1e-6;
}

} // namespace

void PersonTracks::take(Followed& x, std::span<const BodyPart> parts,
                        const Explanation& explanation) {
  const auto measured = measured_place(parts, explanation, options_.likelihood);
  if (has_turned(x.motion, measured, options_.likelihood))
    x.motion.turn_away(options_.likelihood.turned_off, first_speed);
  x.motion.correct(measured.place, measured.variance);
  x.steady.correct(measured.place, steady_noise * measured.variance);
  if (distance(x.steady.place(), x.motion.place()) > options_.swerving)
    x.steady = x.motion;
  auto& track = x.track;
  track.visibility += visibility_share * (1 - track.visibility);
  ++x.detections;
  const auto is_new = [&](std::size_t part) { return parts[part].is_new; };
  if (std::ranges::all_of(explanation.all_parts(), is_new))
    ++x.new_detections;
  x.unseen = x.absent = 0;
  track.velocity = x.steady.velocity();
  if (track.speed() > walking)
    track.heading = std::atan2(track.velocity.y, track.velocity.x);
}

bool PersonTracks::walks(const Followed& x, const ScanView& view) const {
  if (x.detections < options_.confirming || x.track.speed() < options_.confirming_speed)
    return false;
  const double way = distance(x.first_place, x.motion.place());
  if (x.new_detections >= options_.confirming_new * x.detections)
    return way >= options_.confirming_way;
  constexpr double leg = 0.1; // radius, metres
  return way >= options_.vacating_way && view.towards(x.first_place, leg).passed > absent_share;
}

void PersonTracks::miss(Followed& x, const ScanView& view, double dt) const {
  if (x.unseen == 0)
    x.motion = x.steady;
  x.track.visibility -= visibility_share * x.track.visibility;
  x.unseen += dt;
  if (view.towards(x.motion.place(), options_.likelihood.body_radius).passed > absent_share)
    x.absent += dt;
  if (x.unseen > walks_on)
    x.motion.slow_down(std::exp(-slowing * dt));
}

void PersonTracks::begin_at(const Point2& place, double variance) {
  const PersonMotion motion{place, variance, first_speed};
  Followed x{{}, motion, motion, place};
  x.track.visibility = 0.5;
  followed_.push_back(x);
}

void PersonTracks::begin(std::span<const BodyPart> parts, std::vector<bool> used) {
  const auto known = followed_.size();
  const auto is_somebody = [&](const BodyPart& part) {
    return std::any_of(followed_.begin(), followed_.begin() + static_cast<std::ptrdiff_t>(known),
                       [&](const Followed& x) {
                         return x.unseen == 0 &&
                                distance(x.motion.place(), part.place) < options_.apart;
                       });
  };
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!used[i] && parts[i].stands_out && (parts[i].is_new || !parts[i].is_settled) &&
        !is_somebody(parts[i]))
      left.push_back(i);
  // Legs of one person: the nearest to one another first.
  const auto& likelihood = options_.likelihood;
  std::vector<std::pair<double, Explanation>> pairs;
  for (const auto i : left)
    for (const auto j : left)
      if (const double apart = distance(parts[i].place, parts[j].place);
          i < j && apart < likelihood.longest_step && parts[i].width <= likelihood.widest_leg &&
          parts[j].width <= likelihood.widest_leg)
        pairs.push_back({apart, {0, {i, j}, 2}});
  std::ranges::sort(pairs, {}, [](auto& x) { return x.first; });
  for (const auto& [apart, pair] : pairs)
    if (!used[pair.parts[0]] && !used[pair.parts[1]]) {
      used[pair.parts[0]] = used[pair.parts[1]] = true;
      const auto measured = measured_place(parts, pair, likelihood);
      begin_at(measured.place, measured.variance);
    }
  for (const auto i : left)
    if (!used[i]) {
      const auto measured = measured_place(parts, {0, {i, 0}, 1}, likelihood);
      begin_at(measured.place, measured.variance);
    }
}

void PersonTracks::add(std::span<const BodyPart> parts, const ScanView& view, std::int64_t time) {
  const double dt = std::max(0.0, seconds(time - time_));
  time_ = time;
  std::vector<std::vector<Explanation>> explanations;
  for (auto& x : followed_) {
    x.motion.predict(dt, x.unseen > 0 ? options_.hidden_acceleration : options_.acceleration);
    x.steady.predict(dt, options_.steady_acceleration);
    auto& all =
      explanations.emplace_back(explanations_of(x.motion, parts, view, options_.likelihood));
    if (!x.track.is_person)
      for (auto& explanation : all)
        explanation.cost += doubt * static_cast<double>(explanation.number_of_parts);
  }
  const auto chosen = explain_jointly(explanations);
  std::vector<bool> used(parts.size());
  for (std::size_t i = 0; i < followed_.size(); ++i) {
    auto& x = followed_[i];
    const auto& explanation = explanations[i][chosen[i]];
    for (const auto part : explanation.all_parts())
      used[part] = true;
    if (explanation.number_of_parts > 0)
      take(x, parts, explanation);
    else
      miss(x, view, dt);
    x.track.place = x.motion.place();
    if (x.unseen > 0)
      x.track.velocity = x.motion.velocity();
    if (!x.track.is_person && x.unseen == 0 && walks(x, view)) {
      x.track.is_person = true;
      x.track.id = next_id_++;
    }
  }
  begin(parts, std::move(used));
  std::erase_if(followed_, [&](const Followed& x) {
    return x.unseen > (x.track.is_person ? options_.patience : options_.early_patience) ||
           x.absent > options_.absence;
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
