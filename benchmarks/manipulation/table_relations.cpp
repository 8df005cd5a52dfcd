#include "castor/benchmarks/manipulation/table_relations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace castor::manipulation {

namespace {

/// Where who speaks sits, in front of the table.
constexpr Spot viewer{0, -1};
/// Half a right angle to each side.
constexpr double most_off = std::numbers::pi / 4;
constexpr double near_gap = 0.10;
/// Of what counts as done, radians.
constexpr double angle_tolerance = 5 * std::numbers::pi / 180;

} // namespace

double distance(const Spot& a, const Spot& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

std::map<std::string, const RandomThing*> by_name(const TableTask& task) {
  std::map<std::string, const RandomThing*> result;
  for (const auto& x : task.things) {
    auto name = x.name();
    for (int i = 2; result.contains(name); ++i)
      name = x.name() + ' ' + std::to_string(i);
    result[name] = &x;
  }
  return result;
}

bool is_at(const std::string& relation, const RandomThing& thing, const Spot& at,
           const RandomThing& landmark, const Spot& other, bool is_strict) {
  if (relation == "near")
    return distance(at, other) - (thing.size + landmark.size) / 2 <=
           near_gap + (is_strict ? 0 : gap_tolerance);
  const Spot front{viewer.x - other.x, viewer.y - other.y};
  const std::map<std::string, Spot> axes{{"front", front},
                                         {"back", {-front.x, -front.y}},
                                         {"left", {front.y, -front.x}},
                                         {"right", {-front.y, front.x}}};
  const auto& axis = axes.at(relation);
  const Spot way{at.x - other.x, at.y - other.y};
  const double along = way.x * axis.x + way.y * axis.y;
  return std::acos(along / std::hypot(way.x, way.y) / std::hypot(axis.x, axis.y)) <=
         most_off + (is_strict ? 0 : angle_tolerance);
}

double on_side(const std::string& side, const Spot& at) {
  return side == "left" ? -at.x : side == "right" ? at.x : side == "front" ? -at.y : at.y;
}

bool is_wholly_on(const std::string& side, const RandomThing& x, const Spot& at) {
  return on_side(side, at) > x.size / 2 + gap_tolerance;
}

std::vector<std::string> colours_from_left(const std::vector<RandomThing>& things) {
  std::map<std::string, std::pair<double, int>> sums;
  for (const auto& x : things) {
    sums[x.colour].first += x.x;
    ++sums[x.colour].second;
  }
  std::vector<std::pair<double, std::string>> means;
  for (const auto& [colour, sum] : sums)
    means.emplace_back(sum.first / sum.second, colour);
  std::ranges::sort(means);
  std::vector<std::string> result;
  for (auto& [x, colour] : means)
    result.push_back(std::move(colour));
  return result;
}

} // namespace castor::manipulation
