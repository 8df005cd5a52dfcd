#include "castor/planning/motivation/table_spots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace castor::planning {

namespace {

using Landmarks = std::vector<const TableThing*>;

/// The table, from its middle; metres. As in spatial's TableArea.
constexpr double half_width = 0.30;
constexpr double half_depth = 0.26;

/// Where an arm at the table reaches; metres.
constexpr double reach_width = 0.26;
constexpr double reach_depth = 0.18;

/// What stands turned is wider than its disc, metres.
constexpr double narrow_gap = 0.01;

constexpr double step = 0.02;

struct Point {
  double x = 0;
  double y = 0;
};

Point at(const TableThing& x) {
  return {x.x, x.y};
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

bool is_in_reach(const Point& p) {
  return std::abs(p.x) <= reach_width && std::abs(p.y) <= reach_depth;
}

double room_around(const Point& p, const TableThing& thing, std::span<const TableThing> table,
                   const TableThing* also_left_out = nullptr) {
  double result = std::numeric_limits<double>::infinity();
  for (const auto& other : table)
    if (&other != &thing && &other != also_left_out && !other.is_held &&
        other.object != thing.object && other.on != thing.object)
      result = std::min(result, distance(p, at(other)) - other.radius - thing.radius);
  return result;
}

/// Points on a line, from one of its points outwards.
std::vector<Point> along(const Point& from, const Point& direction, double reach) {
  std::vector<Point> result{from};
  for (double way = step; way <= reach; way += step)
    for (const double side : {1.0, -1.0})
      result.push_back({from.x + side * way * direction.x, from.y + side * way * direction.y});
  return result;
}

Point direction_from(const Point& a, const Point& b) {
  const double length = distance(a, b);
  return length < 1e-6 ? Point{1, 0} : Point{(b.x - a.x) / length, (b.y - a.y) / length};
}

std::vector<Point> candidates(std::string_view relation, double gap, const TableThing& thing,
                              const Landmarks& landmarks) {
  const auto first = landmarks.empty() ? Point{} : at(*landmarks.front());
  const auto second = landmarks.size() < 2 ? first : at(*landmarks[1]);
  const Point middle{(first.x + second.x) / 2, (first.y + second.y) / 2};
  const auto line = direction_from(first, second);
  if (relation == "midway")
    return {middle};
  if (relation == "equidistant")
    return along(middle, {-line.y, line.x}, half_width);
  if (relation == "in-line")
    return along(middle, line, 2 * half_width);
  const double beside =
    landmarks.empty() ? 0 : landmarks.front()->radius + thing.radius + std::max(gap, 0.0);
  if (relation == "other-side") {
    const auto away = direction_from(at(thing), first);
    std::vector<Point> result;
    for (double way = beside + finger_gap; way <= half_width; way += step)
      result.push_back({first.x + way * away.x, first.y + way * away.y});
    return result;
  }
  constexpr std::array<std::pair<std::string_view, Point>, 4> sides{
    {{"left", {-1, 0}}, {"right", {1, 0}}, {"front", {0, -1}}, {"back", {0, 1}}}};
  for (const auto& [name, side] : sides)
    if (name == relation)
      return {{first.x + beside * side.x, first.y + beside * side.y}};
  // Around the landmark, from where it is now outwards.
  std::vector<Point> result;
  const auto own = direction_from(first, at(thing));
  const double begin = std::atan2(own.y, own.x);
  constexpr int turns = 12;
  for (int i = 0; i <= turns; ++i)
    for (const double side : {1.0, -1.0}) {
      const double angle = begin + side * i * std::numbers::pi / turns;
      result.push_back({first.x + beside * std::cos(angle), first.y + beside * std::sin(angle)});
    }
  return result;
}

TableSpot spot_of(const TableThing& thing, const Point& p) {
  return {"spot-of-" + thing.object, p.x, p.y};
}

std::optional<TableSpot> roomiest(const TableThing& thing, std::span<const TableThing> table) {
  Point best;
  double most = 0;
  for (double x = -reach_width; x <= reach_width; x += step)
    for (double y = -reach_depth; y <= reach_depth; y += step)
      if (const double room = room_around({x, y}, thing, table); room > most) {
        most = room;
        best = {x, y};
      }
  return most > 0 ? std::optional{spot_of(thing, best)} : std::nullopt;
}

} // namespace

bool is_measured(std::string_view relation, double distance) {
  constexpr std::array<std::string_view, 5> measured{"midway", "equidistant", "in-line",
                                                     "other-side", "roomiest"};
  constexpr std::array<std::string_view, 5> sides{"left", "right", "front", "back", "near"};
  return std::ranges::find(measured, relation) != measured.end() ||
         (distance > 0 && std::ranges::find(sides, relation) != sides.end());
}

std::size_t landmarks_needed(std::string_view relation) {
  if (relation == "roomiest")
    return 0;
  return relation == "midway" || relation == "equidistant" || relation == "in-line" ? 2 : 1;
}

bool is_on_table(double x, double y) {
  return std::abs(x) <= half_width && std::abs(y) <= half_depth;
}

double gap_between(const TableThing& a, const TableThing& b) {
  return distance(at(a), at(b)) - a.radius - b.radius;
}

std::optional<TableSpot> measured_spot(std::string_view relation, double gap,
                                       const TableThing& thing, const Landmarks& landmarks,
                                       std::span<const TableThing> table) {
  if (relation == "roomiest")
    return roomiest(thing, table);
  auto points = candidates(relation, gap, thing, landmarks);
  // Of a line all points are as good: the nearest is taken.
  if (relation == "equidistant" || relation == "in-line")
    std::ranges::stable_sort(points, {}, [&](const Point& p) { return distance(p, at(thing)); });
  // The gap that is asked for may be narrower than fingers.
  for (const double room : {finger_gap, narrow_gap})
    for (const auto& p : points) {
      const auto* landmark = landmarks.size() == 1 ? landmarks.front() : nullptr;
      if (is_in_reach(p) && room_around(p, thing, table, landmark) >= room)
        return spot_of(thing, p);
    }
  return std::nullopt;
}

std::vector<TableSpot> both_sides(const Landmarks& two, const TableThing& middle,
                                  std::span<const TableThing> table) {
  const auto& a = *two.front();
  const auto& b = *two.back();
  const double least = std::max(a.radius, b.radius) + middle.radius + finger_gap;
  const bool is_left = a.x <= b.x;
  const bool is_before = a.y <= b.y;
  for (double way = least; way <= half_width; way += step)
    for (const auto& side : {Point{is_left ? -way : way, 0}, Point{0, is_before ? -way : way}}) {
      const Point p{middle.x + side.x, middle.y + side.y};
      const Point q{middle.x - side.x, middle.y - side.y};
      if (is_in_reach(p) && is_in_reach(q) && room_around(p, a, table, &b) >= narrow_gap &&
          room_around(q, b, table, &a) >= narrow_gap)
        return {spot_of(a, p), spot_of(b, q)};
    }
  return {};
}

} // namespace castor::planning
