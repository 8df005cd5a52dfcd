#include "castor/mapping/body/walking_people.hpp"

#include <algorithm>
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

// Considerate people:
/// As a share of their radius, how narrow they are when they pass one another, or a wall.
constexpr double shoulder = 0.8;
/// They keep so much more than they are wide from one another, and more than they have to from a
/// robot; metres.
constexpr double spare = 0.05;
constexpr double spare_of_robot = 0.02;
/// Who is aside of the route aims so far ahead on it, metres, and is back within that.
constexpr double look_ahead = 1;
constexpr double back_on_route = 0.01;
/// m/s^2, in which they turn aside.
constexpr double agility = 4;
/// Who was hindered for so long begins to squeeze past, and is narrow after so long more; seconds.
constexpr double before_squeezing = 1;
constexpr double squeezing = 4;
/// Slower is hindered, as a share of the speed. The memory of that fades as a share of time.
constexpr double hindering = 0.3;
constexpr double fading = 0.3;
/// What is farther off the direction of walking is not seen: the cosine.
constexpr double out_of_view = -0.2;

/// Whether the robot is in the way from one place to another.
bool is_in_way(const Disc& robot, const Walker& person, const Point2& here, const Point2& next,
               double gap) {
  const double then = distance(next, robot.centre);
  return then < distance(here, robot.centre) && then < robot.radius + person.radius + gap;
}

Point2 operator-(const Point2& a, const Point2& b) {
  return {a.x - b.x, a.y - b.y};
}

Point2 operator*(double a, const Point2& b) {
  return {a * b.x, a * b.y};
}

double dot(const Point2& a, const Point2& b) {
  return a.x * b.x + a.y * b.y;
}

double length(const Point2& x) {
  return std::sqrt(dot(x, x));
}

/// Of now, m/s.
double speed_of(const Walker& x, double from_robot) {
  return x.leads_within > 0 ? x.speed * std::clamp(2 - 2 * from_robot / x.leads_within, 0.0, 1.0)
                            : x.speed;
}

/// Cosine of the angle between two directions; 0 without one.
double cosine(const Point2& a, const Point2& b) {
  const double both = length(a) * length(b);
  return both > 0 ? dot(a, b) / both : 0;
}

} // namespace

WalkingPeople::WalkingPeople(std::vector<Walker> people, bool considerate)
  : considerate_(considerate) {
  for (auto& person : people) {
    discs_.push_back({place_on_route(person, 0), person.radius});
    walks_.emplace_back().person = std::move(person);
  }
}

void WalkingPeople::wait_for_robot(Walk& walk, double dt) {
  walk.waited += dt;
  if (walk.waited < before_detour)
    return;
  walk.waited = 0;
  walk.detour = Detour{walk.at + walk.direction * detour_way, 0, 0, 0};
}

void WalkingPeople::walk_on(Walk& walk, Point2& here, double dt, const Disc& robot, double gap) {
  if (walk.pause > 0) {
    walk.pause -= dt;
    return;
  }
  const double at = walk.at + walk.direction * walk.speed * dt;
  const auto next = place_on_route(walk.person, at);
  if (is_in_way(robot, walk.person, here, next, gap))
    return wait_for_robot(walk, dt);
  walk.waited = 0;
  if (points_reached(walk.person, at) != points_reached(walk.person, walk.at))
    walk.pause = walk.person.pause;
  walk.at = at;
  here = next;
}

void WalkingPeople::walk_around(std::size_t i, double dt, const Disc& robot, double gap,
                                const Obstacles& fixed) {
  auto& walk = walks_[i];
  auto& here = discs_[i].centre;
  auto& detour = *walk.detour;
  detour.time += dt;
  if (detour.time > longest_detour) {
    walk.direction = -walk.direction;
    detour = Detour{walk.at + walk.direction * way_back, 0, 0, 0};
  }
  const double way = walk.speed * dt;
  if (considerate_)
    gap *= std::max(0.3, 1 - detour.time / squeezing);
  const double width = (considerate_ ? shoulder : 1) * walk.person.radius;
  const auto goal = place_on_route(walk.person, detour.to);
  const double straight = std::atan2(goal.y - here.y, goal.x - here.x);
  constexpr int most = 8;
  constexpr double turn = std::numbers::pi / 12;
  const auto go = [&](double side, int turns) {
    const double heading = straight + side * turns * turn;
    const auto next = transform({here.x, here.y, heading}, {way, 0});
    const double room = fixed.clearance(next, 1);
    if (is_in_way(robot, walk.person, here, next, gap) || runs_into_somebody(i, next) ||
        (room < width && room < fixed.clearance(here, 1)))
      return false;
    here = next;
    detour.heading = heading;
    detour.side = turns == 0 ? 0 : side;
    return true;
  };
  bool has_gone = false;
  for (int turns = 0; turns <= most && !has_gone; ++turns)
    has_gone = (detour.side >= 0 && go(1, turns)) || (detour.side <= 0 && go(-1, turns));
  remember_hindrance(walk, !has_gone, dt);
  if (distance(here, goal) > way)
    return;
  walk.at = detour.to;
  here = goal;
  walk.detour.reset();
}

double WalkingPeople::reach(std::size_t i, std::size_t j) const {
  const double hindered = std::max(walks_[i].hindered, walks_[j].hindered);
  const double share = 1 - std::clamp((hindered - before_squeezing) / squeezing, 0.0, 1.0);
  return share * (discs_[i].radius + discs_[j].radius + spare);
}

bool WalkingPeople::runs_into_somebody(std::size_t i, const Point2& next) const {
  if (!considerate_)
    return false;
  const auto& here = discs_[i].centre;
  for (std::size_t j = 0; j < discs_.size(); ++j) {
    const auto& other = discs_[j].centre;
    if (j != i && distance(next, other) < shoulder * reach(i, j) &&
        distance(next, other) < distance(here, other))
      return true;
  }
  return false;
}

std::vector<AvoidedDisc> WalkingPeople::avoided_by(std::size_t i, const Point2& wanted,
                                                   const Robot& robot) const {
  std::vector<AvoidedDisc> result;
  const auto& here = discs_[i].centre;
  for (std::size_t j = 0; j < walks_.size(); ++j) {
    const auto& other = walks_[j];
    const auto there = discs_[j].centre - here;
    const double kept = reach(i, j);
    if (j == i || kept <= 0 || cosine(there, wanted) < out_of_view)
      continue;
    const bool is_mutual =
      !other.detour && other.pause <= 0 && cosine(-1 * there, other.velocity) > out_of_view;
    result.push_back({discs_[j].centre, other.velocity, kept, is_mutual});
  }
  const auto there = robot.disc.centre - here;
  if (cosine(there, wanted) >= out_of_view)
    result.push_back({robot.disc.centre, robot.velocity,
                      robot.disc.radius + discs_[i].radius + passing + spare_of_robot, false});
  return result;
}

void WalkingPeople::remember_hindrance(Walk& walk, bool is_hindered, double dt) {
  walk.hindered = is_hindered ? walk.hindered + dt : std::max(0.0, walk.hindered - fading * dt);
}

double WalkingPeople::ahead_of(const Walk& walk) {
  constexpr double least = 0.3;
  return look_ahead * std::clamp(2 - walk.hindered / squeezing, least, 1.0);
}

void WalkingPeople::keep_up(Walk& walk, Point2& here, bool evades, double dt) const {
  const double ahead = ahead_of(walk);
  const auto before = points_reached(walk.person, walk.at);
  constexpr int parts = 4;
  const double piece = walk.direction * walk.speed * dt / parts;
  for (int k = 0; k < 2 * parts; ++k)
    if (distance(here, place_on_route(walk.person, walk.at + walk.direction * ahead)) < ahead)
      walk.at += piece;
  if (points_reached(walk.person, walk.at) != before)
    walk.pause = walk.person.pause;
  const auto on_route = place_on_route(walk.person, walk.at);
  walk.is_aside = evades || distance(here, on_route) > back_on_route;
  if (!walk.is_aside)
    here = on_route;
}

void WalkingPeople::walk_among(std::size_t i, double dt, const Robot& robot,
                               const Obstacles& fixed) {
  auto& walk = walks_[i];
  auto& here = discs_[i].centre;
  if (walk.pause > 0) {
    walk.pause -= dt;
    walk.velocity = {};
    return;
  }
  const double speed = walk.speed;
  const double ahead = ahead_of(walk);
  const auto aim =
    place_on_route(walk.person, walk.at + walk.direction * (walk.is_aside ? ahead : speed * dt));
  const auto way = aim - here;
  const auto wanted = length(way) > 0 ? speed / std::max(speed * dt, length(way)) * way : way;
  const auto is_free = [&](const Point2& velocity) {
    constexpr double foreseen = 0.25; // seconds
    const double room = fixed.clearance(here, 1);
    for (const double t : {dt, foreseen}) {
      const double then = fixed.clearance({here.x + velocity.x * t, here.y + velocity.y * t}, 1);
      if (then < shoulder * walk.person.radius && then < room)
        return false;
    }
    return true;
  };
  auto velocity =
    velocity_among(here, walk.velocity, wanted, avoided_by(i, wanted, robot), is_free);
  const bool evades = velocity != wanted;
  const bool goes_on = !walk.is_aside && !evades;
  if (const auto change = velocity - walk.velocity; !goes_on && length(change) > agility * dt) {
    const auto part = agility * dt / length(change) * change;
    const Point2 slewed{walk.velocity.x + part.x, walk.velocity.y + part.y};
    velocity = is_free(slewed) ? slewed : velocity;
  }
  Point2 next{here.x + velocity.x * dt, here.y + velocity.y * dt};
  const double towards = std::max(0.0, cosine(here - robot.disc.centre, robot.velocity));
  const double gap = passing + foresight * towards * length(robot.velocity);
  const bool is_robot_in_way = is_in_way(robot.disc, walk.person, here, next, gap);
  if (is_robot_in_way || runs_into_somebody(i, next)) {
    velocity = {};
    next = here;
  }
  const bool is_hindered =
    dot(velocity, wanted) < hindering * std::min(speed, length(wanted)) * length(wanted);
  remember_hindrance(walk, is_hindered, dt);
  walk.velocity = velocity;
  if (length(velocity) > hindering * speed)
    walk.heading = std::atan2(velocity.y, velocity.x);
  const bool is_robot_near =
    distance(here, robot.disc.centre) < robot.disc.radius + walk.person.radius + politeness;
  if (is_robot_in_way || (is_hindered && is_robot_near))
    return wait_for_robot(walk, dt);
  walk.waited = 0;
  here = next;
  if (!goes_on)
    return keep_up(walk, here, evades, dt);
  const double at = walk.at + walk.direction * speed * dt;
  if (points_reached(walk.person, at) != points_reached(walk.person, walk.at))
    walk.pause = walk.person.pause;
  walk.at = at;
  here = aim;
}

void WalkingPeople::step(double dt, const Disc& robot, const Obstacles& fixed) {
  const auto moved = robot_before_ ? robot.centre - *robot_before_ : Point2{};
  robot_before_ = robot.centre;
  const double ahead = foresight * length(moved) / dt;
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    walks_[i].speed = speed_of(walks_[i].person, distance(discs_[i].centre, robot.centre));
    if (walks_[i].detour)
      walk_around(i, dt, robot, passing + ahead, fixed);
    else if (considerate_)
      walk_among(i, dt, {robot, 1 / dt * moved}, fixed);
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
    const double heading = walk.detour     ? walk.detour->heading
                           : walk.is_aside ? walk.heading
                                           : std::atan2(next.y - at.y, next.x - at.x);
    const double walked = walk.at + (walk.detour ? walk.detour->time * walk.person.speed : 0);
    const double ahead = swing * std::sin(2 * std::numbers::pi * walked / stride);
    for (const double side : {-1, 1})
      result.push_back(
        {transform({at.x, at.y, heading}, {side * ahead, side * aside}), leg_radius});
  }
  return result;
}

} // namespace castor::mapping
