#include "castor/mapping/body/walking_people.hpp"

#include <utility>

namespace castor::mapping {

namespace {

/// People keep that far away from a robot, metres.
constexpr double politeness = 0.2;

} // namespace

WalkingPeople::WalkingPeople(std::vector<Person> people)
  : people_(std::move(people)), walked_(people_.size()) {
  for (const auto& person : people_)
    discs_.push_back({place_on_route(person, 0), person.radius});
}

void WalkingPeople::step(double dt, const Disc& robot) {
  for (std::size_t i = 0; i < people_.size(); ++i) {
    const double walked = walked_[i] + people_[i].speed * dt;
    const auto place = place_on_route(people_[i], walked);
    const double now = distance(discs_[i].centre, robot.centre);
    const double then = distance(place, robot.centre);
    if (then < now && then < robot.radius + discs_[i].radius + politeness)
      continue;
    walked_[i] = walked;
    discs_[i].centre = place;
  }
}

} // namespace castor::mapping
