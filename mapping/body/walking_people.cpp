#include "castor/mapping/body/walking_people.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace castor::mapping {

namespace {

/// People keep that far away from a robot, metres.
constexpr double politeness = 0.2;
/// They walk back after waiting for a robot that long, seconds.
constexpr double patience = 3;

} // namespace

WalkingPeople::WalkingPeople(std::vector<Walker> people) {
  for (auto& person : people) {
    discs_.push_back({place_on_route(person, 0), person.radius});
    walks_.push_back({std::move(person)});
  }
}

void WalkingPeople::step(double dt, const Disc& robot) {
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    auto& walk = walks_[i];
    if (walk.pause > 0) {
      walk.pause -= dt;
      continue;
    }
    const double at = walk.at + walk.direction * walk.person.speed * dt;
    const auto place = place_on_route(walk.person, at);
    const double now = distance(discs_[i].centre, robot.centre);
    const double then = distance(place, robot.centre);
    if (then < now && then < robot.radius + walk.person.radius + politeness) {
      walk.waited += dt;
      if (walk.waited < patience)
        continue;
      walk.waited = 0;
      walk.direction = -walk.direction;
      continue;
    }
    walk.waited = 0;
    if (points_reached(walk.person, at) != points_reached(walk.person, walk.at))
      walk.pause = walk.person.pause;
    walk.at = at;
    discs_[i].centre = place;
  }
}

std::vector<Disc> WalkingPeople::legs() const {
  constexpr double leg_radius = 0.07; // metres
  // From the middle of the body to each leg, and how far a leg swings; a step takes half a stride.
  constexpr double aside = 0.11;
  constexpr double swing = 0.22;
  constexpr double stride = 1.3;
  std::vector<Disc> result;
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    const auto& walk = walks_[i];
    const auto& at = discs_[i].centre;
    constexpr double little = 0.05; // metres
    const auto next = place_on_route(walk.person, walk.at + walk.direction * little);
    const double heading = std::atan2(next.y - at.y, next.x - at.x);
    const double ahead = swing * std::sin(2 * std::numbers::pi * walk.at / stride);
    for (const double side : {-1, 1})
      result.push_back(
        {transform({at.x, at.y, heading}, {side * ahead, side * aside}), leg_radius});
  }
  return result;
}

} // namespace castor::mapping
