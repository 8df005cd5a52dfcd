#include "castor/planning/motivation/table_spots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace castor::planning {

namespace {

using Landmarks = std::vector<const TableThing*>;

/// What stands turned is wider than its disc, metres.
constexpr double narrow_gap = 0.01;

/// By which a gap grows where it is not said by how much, metres.
constexpr double farther_by = 0.05;

/// Between the points of a line that are looked at, metres.
constexpr double step = 0.02;

/// Points on a line, from one of its points outwards.
std::vector<TablePoint> along(const TablePoint& from, const TablePoint& direction, double reach) {
  std::vector<TablePoint> result{from};
  for (double way = step; way <= reach; way += step)
    for (const double side : {1.0, -1.0})
      result.push_back({from.x + side * way * direction.x, from.y + side * way * direction.y});
  return result;
}

TablePoint direction_from(const TablePoint& a, const TablePoint& b) {
  const double length = distance(a, b);
  return length < 1e-6 ? TablePoint{1, 0} : TablePoint{(b.x - a.x) / length, (b.y - a.y) / length};
}

/// "Closer" and "farther"; nothing if it cannot be closer.
/// @param change of the gap as it is said, or 0
std::optional<double> changed_gap(std::string_view relation, double change, double gap) {
  if (relation == "farther")
    return gap + (change > 0 ? change : farther_by);
  const double closer = change > 0 ? gap - change : gap / 2;
  return closer < narrow_gap ? std::nullopt : std::optional{closer};
}

/// So far from an edge of the table, or towards its middle.
std::vector<TablePoint> at_part(std::string_view part, double metres, const TableThing& thing) {
  const auto own = place_of(thing);
  if (part == "centre") {
    const double way = std::hypot(own.x, own.y);
    const double left = way < 1e-6 ? 0 : std::max(way - metres, 0.0) / way;
    return {{own.x * left, own.y * left}};
  }
  const double x = table_half_width - metres - thing.radius;
  const double y = table_half_depth - metres - thing.radius;
  const auto across = [&](double at) { return along({at, own.y}, {0, 1}, 2 * table_half_depth); };
  const auto beside = [&](double at) { return along({own.x, at}, {1, 0}, 2 * table_half_width); };
  if (part == "left-edge")
    return across(-x);
  if (part == "right-edge")
    return across(x);
  if (part == "front-edge")
    return beside(-y);
  if (part == "back-edge")
    return beside(y);
  // The nearest edge.
  return table_half_width - std::abs(own.x) < table_half_depth - std::abs(own.y)
           ? across(own.x < 0 ? -x : x)
           : beside(own.y < 0 ? -y : y);
}

std::vector<TablePoint> candidates(std::string_view relation, double gap, const TableThing& thing,
                                   const Landmarks& landmarks) {
  const auto first = landmarks.empty() ? TablePoint{} : place_of(*landmarks.front());
  const auto second = landmarks.size() < 2 ? first : place_of(*landmarks[1]);
  const TablePoint middle{(first.x + second.x) / 2, (first.y + second.y) / 2};
  const auto line = direction_from(first, second);
  if (relation == "midway")
    return {middle};
  if (relation == "equidistant")
    return along(middle, {-line.y, line.x}, table_half_width);
  const auto row = along({thing.x, first.y}, {1, 0}, 2 * table_half_width);
  const auto column = along({first.x, thing.y}, {0, 1}, 2 * table_half_depth);
  if (relation == "level")
    return row;
  if (relation == "level-across")
    return column;
  if (relation == "in-line" && landmarks.size() == 1) {
    auto both = row;
    both.insert(both.end(), column.begin(), column.end());
    return both;
  }
  if (relation == "in-line")
    return along(middle, line, 2 * table_half_width);
  if (landmarks.empty())
    return at_part(relation, gap, thing);
  const double beside = landmarks.front()->radius + thing.radius + std::max(gap, 0.0);
  if (relation == "other-side") {
    const auto away = direction_from(place_of(thing), first);
    std::vector<TablePoint> result;
    for (double way = beside + finger_gap; way <= table_half_width; way += step)
      result.push_back({first.x + way * away.x, first.y + way * away.y});
    return result;
  }
  if (relation == "closer" || relation == "farther") {
    const auto own = direction_from(first, place_of(thing));
    const auto wanted = changed_gap(relation, gap, gap_between(thing, *landmarks.front()));
    if (!wanted)
      return {};
    const double way = beside - std::max(gap, 0.0) + *wanted;
    return {{first.x + way * own.x, first.y + way * own.y}};
  }
  constexpr std::array<std::pair<std::string_view, TablePoint>, 4> sides{
    {{"left", {-1, 0}}, {"right", {1, 0}}, {"front", {0, -1}}, {"back", {0, 1}}}};
  for (const auto& [name, side] : sides)
    if (name == relation)
      return {{first.x + beside * side.x, first.y + beside * side.y}};
  // Around the landmark, from where it is now outwards.
  std::vector<TablePoint> result;
  const auto own = direction_from(first, place_of(thing));
  const double begin = std::atan2(own.y, own.x);
  constexpr int turns = 12;
  for (int i = 0; i <= turns; ++i)
    for (const double side : {1.0, -1.0}) {
      const double angle = begin + side * i * std::numbers::pi / turns;
      result.push_back({first.x + beside * std::cos(angle), first.y + beside * std::sin(angle)});
    }
  return result;
}

std::optional<TableSpot> roomiest(const TableThing& thing, const TableRoom& room) {
  std::optional<TablePoint> best;
  double most = 0;
  for (double x = -table_half_width; x <= table_half_width; x += room_step)
    for (double y = -table_half_depth; y <= table_half_depth; y += room_step)
      if (const auto effort = room.effort(thing, {x, y}))
        if (const double value = room.room_around({x, y}, thing) - *effort; !best || value > most) {
          most = value;
          best = {x, y};
        }
  if (!best || room.room_around(*best, thing) <= 0)
    return std::nullopt;
  return spot_for(thing, *best);
}

} // namespace

bool is_measured(std::string_view relation, double distance) {
  constexpr std::array<std::string_view, 9> measured{"midway",   "equidistant",  "in-line",
                                                     "level",    "level-across", "other-side",
                                                     "roomiest", "closer",       "farther"};
  constexpr std::array<std::string_view, 11> sides{
    "left",      "right",      "front",      "back",      "near", "centre",
    "left-edge", "right-edge", "front-edge", "back-edge", "edge"};
  return std::ranges::find(measured, relation) != measured.end() ||
         (distance > 0 && std::ranges::find(sides, relation) != sides.end());
}

bool takes_landmarks(std::string_view relation, std::size_t number) {
  if (relation == "in-line")
    return number == 1 || number == 2;
  return number == landmarks_needed(relation);
}

std::size_t landmarks_needed(std::string_view relation) {
  if (relation == "roomiest" || relation == "centre" || relation.ends_with("edge"))
    return 0;
  return relation == "midway" || relation == "equidistant" || relation == "in-line" ? 2 : 1;
}

bool is_on_table(double x, double y) {
  return std::abs(x) <= table_half_width && std::abs(y) <= table_half_depth;
}

std::optional<TableSpot> measured_spot(std::string_view relation, double gap,
                                       const TableThing& thing, const Landmarks& landmarks,
                                       const TableRoom& room) {
  if (relation == "roomiest")
    return roomiest(thing, room);
  auto points = candidates(relation, gap, thing, landmarks);
  // Of a line all points are as good: the nearest is taken.
  if (relation == "equidistant" || relation == "in-line" || relation.starts_with("level") ||
      relation.ends_with("edge"))
    std::ranges::stable_sort(points, {},
                             [&](const TablePoint& p) { return distance(p, place_of(thing)); });
  const auto* landmark = landmarks.size() == 1 ? landmarks.front() : nullptr;
  // The gap that is asked for may be narrower than fingers.
  for (const double least_gap : {finger_gap, narrow_gap}) {
    const TablePoint* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& p : points)
      if (const auto effort = room.effort(thing, p);
          effort && *effort < least && room.room_around(p, thing, {landmark}) >= least_gap) {
        least = *effort;
        best = &p;
      }
    if (best != nullptr)
      return spot_for(thing, *best);
  }
  return std::nullopt;
}

std::vector<TableSpot> both_sides(const Landmarks& two, const TableThing& middle,
                                  const TableRoom& room) {
  const auto& a = *two.front();
  const auto& b = *two.back();
  const double nearest = std::max(a.radius, b.radius) + middle.radius + finger_gap;
  const bool is_left = a.x <= b.x;
  const bool is_before = a.y <= b.y;
  double least = std::numeric_limits<double>::infinity();
  std::vector<TableSpot> result;
  for (double way = nearest; way <= table_half_width; way += step)
    for (const auto& side :
         {TablePoint{is_left ? -way : way, 0}, TablePoint{0, is_before ? -way : way}}) {
      const TablePoint p{middle.x + side.x, middle.y + side.y};
      const TablePoint q{middle.x - side.x, middle.y - side.y};
      const auto effort = room.effort(a, p);
      const auto other_effort = room.effort(b, q);
      if (effort && other_effort && way + *effort + *other_effort < least &&
          room.room_around(p, a, {&b}) >= narrow_gap &&
          room.room_around(q, b, {&a}) >= narrow_gap) {
        least = way + *effort + *other_effort;
        result = {spot_for(a, p), spot_for(b, q)};
      }
    }
  return result;
}

} // namespace castor::planning
