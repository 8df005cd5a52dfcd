#include "castor/benchmarks/people/scenes.hpp"

#include "castor/base/text_file.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

namespace castor::benchmark {

namespace {

using namespace mapping;

/// Metres that routes stay away from obstacles and from the robot's start.
constexpr double route_clearance = 0.35;
constexpr double start_clearance = 1.2;

const char* const empty_room = "wall 0 0 to 10 0 to 10 8 to 0 8 close\n"
                               "start 1 4\n";

const char* const furnished_room = "wall 0 0 to 10 0 to 10 8 to 0 8 close\n"
                                   "furniture table at 3.5 6 box 1.6 0.8 0.74 legs\n"
                                   "furniture table at 6 2.2 box 1.2 0.8 0.74 legs\n"
                                   "furniture table at 7.5 5.5 disc 1 0.74 legs\n"
                                   "furniture chair at 3.4 5.2 disc 0.5 0.45\n"
                                   "furniture chair at 6.1 3 disc 0.5 0.45\n"
                                   "furniture chair at 8.4 5.2 disc 0.45 0.45\n"
                                   "furniture chair at 2.8 2 disc 0.5 0.45\n"
                                   "furniture shelf at 9.7 3 box 0.4 2 1.9\n"
                                   "start 1 4\n";

class Random {
public:
  explicit Random(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool coin() { return between(0, 1) < 0.5; }

private:
  std::mt19937_64 random_;
};

Building building_of(const std::string& text) {
  return parse_building(text, "scene").building;
}

Walker walker(std::vector<Point2> route, double speed) {
  Walker result;
  result.name = "somebody";
  result.route = std::move(route);
  result.speed = speed;
  return result;
}

/// Two people whose ways cross near `middle`, who come there at the same time, again and again.
void add_crossing(Building& x, Random& random, const Point2& middle, double first, double second) {
  constexpr double half = 2; // metres
  const double apart = random.between(0.2, 0.5) * (random.coin() ? 1 : -1);
  const double speed = random.between(0.6, 1.2);
  const auto route = [&](double direction, double aside) {
    const Pose2 pose{middle.x, middle.y, direction};
    return std::vector<Point2>{transform(pose, Point2{-half, aside}),
                               transform(pose, Point2{half, aside})};
  };
  x.people.push_back(walker(route(first, apart / 2), speed));
  // Of two who meet head on, the left is on the other side.
  const double side = std::cos(second - first) < 0 ? 1 : -1;
  x.people.push_back(walker(route(second, side * apart / 2), speed));
}

Scene crossing(Random& random) {
  Scene result{building_of(empty_room), {}};
  const Point2 middle{random.between(3.2, 6), random.between(2.6, 5.4)};
  const double first = random.between(-std::numbers::pi, std::numbers::pi);
  const double angle = random.between(std::numbers::pi / 6, std::numbers::pi);
  add_crossing(result.building, random, middle, first, first + angle);
  return result;
}

Scene occlusion(Random& random) {
  const Point2 middle{random.between(3.5, 5.5), random.between(3, 5)};
  const auto text = fmt::format("{}furniture column at {:.3f} {:.3f} disc 0.5 2.5\n", empty_room,
                                std::lerp(1, middle.x, 0.6), std::lerp(4, middle.y, 0.6));
  Scene result{building_of(text), {}};
  const double across = std::numbers::pi / 2;
  add_crossing(result.building, random, middle, across + random.between(-0.5, 0.5),
               -across + random.between(-0.5, 0.5));
  return result;
}

/// Draws routes on which nobody walks through an obstacle or over the robot's start.
class Routes {
public:
  Routes(const Building& x, Random& random)
    : obstacles_(between_heights(solids_of(x), 0, 2)),
      extent_(extent(x)), start_{x.start.x, x.start.y}, random_(random) {}

  std::vector<Point2> draw(std::size_t points) {
    std::vector<Point2> result;
    while (result.size() < points) {
      const Point2 next{random_.between(extent_.low.x, extent_.high.x),
                        random_.between(extent_.low.y, extent_.high.y)};
      const auto& last = result.empty() ? next : result.back();
      constexpr double shortest = 1.5; // metres
      const bool is_far = result.empty() || distance(last, next) > shortest;
      if (is_far && is_free(last, next))
        result.push_back(next);
    }
    return result;
  }

private:
  bool is_free(const Point2& a, const Point2& b) const {
    const int steps = static_cast<int>(distance(a, b) / 0.1) + 1;
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const Point2 p{std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share)};
      if (distance(p, start_) < start_clearance ||
          obstacles_.clearance(p, route_clearance) < route_clearance)
        return false;
    }
    return true;
  }

  SolidObstacles obstacles_;
  Extent extent_;
  Point2 start_;
  Random& random_;
};

Scene together(Random& random) {
  Scene result{building_of(empty_room), {}};
  for (int pair = 0; pair < 2; ++pair) {
    constexpr double apart = 0.6; // metres
    // Straight ways, so that both have the same length.
    const Point2 middle{random.between(3.5, 6.5), random.between(2.5, 5.5)};
    const Pose2 pose{middle.x, middle.y, random.between(-std::numbers::pi, std::numbers::pi)};
    const double half = random.between(1, 1.9);
    const double speed = random.between(0.6, 1.1);
    for (const double side : {-apart / 2, apart / 2})
      result.building.people.push_back(
        walker({transform(pose, Point2{-half, side}), transform(pose, Point2{half, side})}, speed));
  }
  return result;
}

/// @param pause longest pause at a point of a route, seconds
Scene crowd(const char* room, Random& random, int people, double pause) {
  Scene result{building_of(room), {}};
  Routes routes{result.building, random};
  for (int i = 0; i < people; ++i) {
    auto person = walker(routes.draw(8), random.between(0.5, 1.2));
    person.pause = pause > 0 ? random.between(2, pause) : 0;
    result.building.people.push_back(std::move(person));
  }
  return result;
}

/// Four people around the corridor of the default building, in both directions.
void add_corridor_walkers(Building& x, Random& random) {
  const std::vector<Point2> round{{0.9, 5.1},  {9, 5.1}, {16.9, 5.1},
                                  {16.9, 9.9}, {9, 9.9}, {0.9, 9.9}};
  for (int i = 0; i < 4; ++i) {
    auto route = round;
    std::rotate(route.begin(), route.begin() + i + 1, route.end());
    if (i % 2 == 0)
      std::reverse(route.begin(), route.end());
    const double aside = random.between(-0.25, 0.25);
    for (auto& p : route)
      p.y += aside;
    auto person = walker(std::move(route), random.between(0.6, 1.1));
    person.is_loop = true;
    x.people.push_back(std::move(person));
  }
}

std::string buildings() {
  return std::string{CASTOR_CONFIGS} + "/buildings/";
}

/// The two who are in its file, and four more around the corridor, in both directions.
Scene office(Random& random, bool drives) {
  Scene result{load_building(buildings() + "office.building").building, {}};
  for (auto& x : result.building.people)
    x.speed = random.between(0.6, 1.1);
  add_corridor_walkers(result.building, random);
  if (drives)
    result.path = parse_path(load_text(buildings() + "office.path"), "office.path").path;
  return result;
}

} // namespace

const std::vector<std::string>& scene_names() {
  static const std::vector<std::string> names{"crossing", "occlusion", "together", "hall",
                                              "standing", "furniture", "office",   "driving"};
  return names;
}

Scene scene(const std::string& name, std::uint64_t seed) {
  Random random{seed};
  if (name == "crossing")
    return crossing(random);
  if (name == "occlusion")
    return occlusion(random);
  if (name == "together")
    return together(random);
  if (name == "hall")
    return crowd(empty_room, random, 7, 0);
  if (name == "standing")
    return crowd(empty_room, random, 5, 8);
  if (name == "furniture")
    return crowd(furnished_room, random, 4, 0);
  if (name == "office" || name == "driving")
    return office(random, name == "driving");
  throw std::invalid_argument("there is no scene '" + name +
                              "': write crossing, occlusion, together, hall, standing, furniture, "
                              "office, driving or all");
}

Building walk_to_follow(const std::string& name, std::uint64_t seed) {
  Random random{seed};
  auto result = load_building(buildings() + "office.building").building;
  auto person = walker({{4, 5.1},
                        {16.8, 5.1},
                        {16.8, 9.9},
                        {15, 9.9},
                        {15, 12.2},
                        {13, 12.4},
                        {12, 12},
                        {10.5, 12},
                        {8, 12},
                        {8, 9.9},
                        {0.9, 9.9},
                        {0.9, 5.1}},
                       random.between(0.45, 0.75));
  person.is_loop = true;
  if (name == "pauses")
    person.pause = random.between(1, 5);
  if (name == "guide")
    person.leads_within = 4;
  result.people = {std::move(person)};
  if (name == "others" || name == "heedless" || name == "guide")
    add_corridor_walkers(result, random);
  result.start = {2.5, 5.1, 0};
  return result;
}

} // namespace castor::benchmark
