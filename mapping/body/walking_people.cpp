#include "castor/mapping/body/walking_people.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace castor::mapping {

namespace {

/// People stop so far before a robot, metres, and walk around it at least so far from it; before
/// one that moves, as far as it comes in so many seconds more.
constexpr double politeness = 0.2;
constexpr double passing = 0.1;
constexpr double foresight = 0.3;
/// They walk around it after waiting that long, seconds, to so far on, metres.
constexpr double before_detour = 1;
constexpr double detour_way = 1.4;
/// They walk back if they have not got around it after so long, seconds; so far first, metres.
constexpr double longest_detour = 6;
constexpr double way_back = 0.8;

/// Whether the robot is in the way from one place to another.
bool is_in_way(const Disc& robot, const Walker& person, const Point2& here, const Point2& next,
               double gap) {
  const double then = distance(next, robot.centre);
  return then < distance(here, robot.centre) && then < robot.radius + person.radius + gap;
}

} // namespace

WalkingPeople::WalkingPeople(std::vector<Walker> people) {
  for (auto& person : people) {
    discs_.push_back({place_on_route(person, 0), person.radius});
    walks_.emplace_back().person = std::move(person);
  }
}

void WalkingPeople::walk_on(Walk& walk, Point2& here, double dt, const Disc& robot,
                            double gap) const {
  if (walk.pause > 0) {
    walk.pause -= dt;
    return;
  }
  const double at = walk.at + walk.direction * walk.person.speed * dt;
  const auto next = place_on_route(walk.person, at);
  if (!is_in_way(robot, walk.person, here, next, gap)) {
    walk.waited = 0;
    if (points_reached(walk.person, at) != points_reached(walk.person, walk.at))
      walk.pause = walk.person.pause;
    walk.at = at;
    here = next;
    return;
  }
  walk.waited += dt;
  if (walk.waited < before_detour)
    return;
  walk.waited = 0;
  walk.detour = Detour{walk.at + walk.direction * detour_way, 0, 0, 0};
}

void WalkingPeople::walk_around(Walk& walk, Point2& here, double dt, const Disc& robot, double gap,
                                const Obstacles& fixed) const {
  auto& detour = *walk.detour;
  detour.time += dt;
  if (detour.time > longest_detour) {
    walk.direction = -walk.direction;
    detour = Detour{walk.at + walk.direction * way_back, 0, 0, 0};
  }
  const double way = walk.person.speed * dt;
  const auto goal = place_on_route(walk.person, detour.to);
  const double straight = std::atan2(goal.y - here.y, goal.x - here.x);
  constexpr int most = 8;
  constexpr double turn = std::numbers::pi / 12;
  const auto go = [&](double side, int turns) {
    const double heading = straight + side * turns * turn;
    const auto next = transform({here.x, here.y, heading}, {way, 0});
    const double room = fixed.clearance(next, 1);
    if (is_in_way(robot, walk.person, here, next, gap) ||
        (room < walk.person.radius && room < fixed.clearance(here, 1)))
      return false;
    here = next;
    detour.heading = heading;
    detour.side = turns == 0 ? 0 : side;
    return true;
  };
  bool has_gone = false;
  for (int turns = 0; turns <= most && !has_gone; ++turns)
    has_gone = (detour.side >= 0 && go(1, turns)) || (detour.side <= 0 && go(-1, turns));
  if (distance(here, goal) > way)
    return;
  walk.at = detour.to;
  here = goal;
  walk.detour.reset();
}

void WalkingPeople::step(double dt, const Disc& robot, const Obstacles& fixed) {
  const double moved = robot_before_ ? distance(*robot_before_, robot.centre) : 0;
  robot_before_ = robot.centre;
  const double ahead = foresight * moved / dt;
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    if (walks_[i].detour)
      walk_around(walks_[i], discs_[i].centre, dt, robot, passing + ahead, fixed);
    else
      walk_on(walks_[i], discs_[i].centre, dt, robot, politeness + ahead);
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
    const double heading =
      walk.detour ? walk.detour->heading : std::atan2(next.y - at.y, next.x - at.x);
    const double walked = walk.at + (walk.detour ? walk.detour->time * walk.person.speed : 0);
    const double ahead = swing * std::sin(2 * std::numbers::pi * walked / stride);
    for (const double side : {-1, 1})
      result.push_back(
        {transform({at.x, at.y, heading}, {side * ahead, side * aside}), leg_radius});
  }
  return result;
}

} // namespace castor::mapping
