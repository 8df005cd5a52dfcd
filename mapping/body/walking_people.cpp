#include "castor/mapping/body/walking_people.hpp"

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
    walk.at = at;
    discs_[i].centre = place;
  }
}

} // namespace castor::mapping
