#include "castor/planning/manipulation/way_between.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/plan_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>
#include <variant>

namespace castor::manipulation {

namespace {

using std::numbers::pi;

/// Stops to which no way is found, after which others are not tried: each takes seconds.
constexpr int most_without_way = 3;

/// Nearer to it an arm like the Katana grasps from straight above, so that it can turn what it
/// holds, metres. Others need no such places.
constexpr double straight_down = 0.245;

/// What is put down may be seen turned by so much, radians.
constexpr double likely_turn = 0.06;

/// Places at hand from which a thing is brought farther out when it was turned there.
constexpr std::size_t most_at_hand = 3;

/// Further turns of a thing about the vertical; what is round is the same from all sides.
std::vector<double> turns_of(const NamedSolid& thing) {
  return thing.solid.kind == SolidKind::box ? std::vector{0.0, pi / 4, pi / 8, 3 * pi / 8}
                                            : std::vector{0.0};
}

double gap(const Point3& x) {
  return std::hypot(x.x, x.y);
}

/// Some of the places at each distance from the arm, the first ones; more at hand.
std::vector<Point3> of_all_distances(const std::vector<Point3>& places) {
  constexpr double step = 0.02;
  constexpr int most_near = 4;
  constexpr int most_far = 2;
  std::map<long, int> counts;
  std::vector<Point3> result;
  for (const auto& x : places)
    if (++counts[std::lround(gap(x) / step)] <= (gap(x) < straight_down ? most_near : most_far))
      result.push_back(x);
  return result;
}

PlaceGoal between(const Point3& place, double turn) {
  return {place, 0, "the table", "a place between", turn};
}

} // namespace

StopsBetween::StopsBetween(const ManipulationPlanner& planner, Scene scene, std::string thing,
                           const std::vector<Point3>& places, Configuration start)
  : planner_(planner), scene_(std::move(scene)), thing_(std::move(thing)),
    start_(std::move(start)) {
  const auto turns = turns_of(named(scene_, thing_));
  // Where it can be turned, the farthest first: from there it gets farther out than from others.
  auto stops = of_all_distances(places);
  const auto farther =
    std::ranges::stable_partition(stops, [&](const Point3& x) { return gap(x) < straight_down; });
  const auto first_farther = stops.size() - farther.size();
  std::ranges::stable_sort(stops.begin(), farther.begin(), std::ranges::greater{}, gap);
  const auto at_hand = std::min(first_farther, most_at_hand);
  std::vector<std::size_t> at_hand_stops;
  const auto add = [&](std::size_t i, double turn, std::optional<std::size_t> before) {
    if (i < at_hand)
      at_hand_stops.push_back(stops_.size());
    stops_.push_back({between(stops[i], turn), before});
  };
  for (const double turn : turns)
    for (std::size_t i = 0; i < stops.size(); ++i)
      add(i, turn, {});
  for (std::size_t i = 0; i < stops.size(); ++i)
    for (const double turn : turns)
      if (turn != 0)
        add(i, turn, i);
  // From there it is brought farther out, if no grasp fits its goal there.
  for (const auto before : at_hand_stops)
    for (const auto& place : farther)
      stops_.push_back({between(place, 0), before});
}

bool StopsBetween::are_for(const Scene& scene, const std::string& thing,
                           const Configuration& start) const {
  return scene == scene_ && thing == thing_ && start == start_;
}

std::optional<ManipulationPlan> StopsBetween::plan_to(const PlaceGoal& goal) {
  std::vector<std::size_t> narrow;
  int without_way = 0;
  const auto plan_by = [&](std::size_t i) -> std::optional<ManipulationPlan> {
    auto plan = planner_.pick_and_place(scene_, thing_, first_place(stops_[i]), start_);
    if (auto* found = std::get_if<ManipulationPlan>(&plan))
      return std::move(*found);
    ++without_way;
    return {};
  };
  for (std::size_t i = 0; i < stops_.size() && without_way < most_without_way; ++i) {
    if (!lands_from(i, goal))
      continue;
    if (!lands_surely_from(i, goal))
      narrow.push_back(i);
    else if (auto plan = plan_by(i))
      return plan;
  }
  for (std::size_t i = 0; i < narrow.size() && without_way < most_without_way; ++i)
    if (auto plan = plan_by(narrow[i]))
      return plan;
  return {};
}

bool StopsBetween::reach(const PlaceGoal& goal) {
  for (std::size_t i = 0; i < stops_.size(); ++i)
    if (!stops_[i].before && lands_from(i, goal) && lands_surely_from(i, goal))
      return true;
  return false;
}

bool StopsBetween::lands_from(std::size_t index, const PlaceGoal& goal) {
  const auto& ways = ways_from(index);
  return ways && planner_.landing_of(*ways, goal);
}

/// Also if it does not stand quite as it was to be put there.
bool StopsBetween::lands_surely_from(std::size_t index, const PlaceGoal& goal) const {
  const auto& there = *stops_[index].pose;
  for (const double turn : {-likely_turn, likely_turn}) {
    auto turned = there;
    turned.rotation = geometry::compose(geometry::rotation_about_z(turn), there.rotation);
    if (!planner_.landing_of(ways_at(turned), goal))
      return false;
  }
  return true;
}

const ManipulationPlanner::WaysToTake& StopsBetween::ways_from_here() {
  if (!here_)
    here_ = planner_.ways_to_take(scene_, thing_, start_);
  return *here_;
}

const PlaceGoal& StopsBetween::first_place(const Stop& stop) const {
  return stop.before ? first_place(stops_[*stop.before]) : stop.place;
}

const std::optional<ManipulationPlanner::WaysToTake>& StopsBetween::ways_from(std::size_t index) {
  auto& stop = stops_[index];
  if (std::exchange(stop.is_tried, true))
    return stop.ways;
  const auto* ways = &ways_from_here();
  if (stop.before) {
    const auto& before = ways_from(*stop.before);
    if (!before)
      return stop.ways;
    ways = &*before;
  }
  stop.pose = planner_.landing_of(*ways, stop.place);
  if (stop.pose)
    stop.ways = ways_at(*stop.pose);
  return stop.ways;
}

ManipulationPlanner::WaysToTake StopsBetween::ways_at(const Pose& pose) const {
  auto scene = scene_;
  std::ranges::find(scene.things, thing_, &NamedSolid::name)->pose = pose;
  return planner_.ways_to_take(scene, thing_, start_);
}

} // namespace castor::manipulation
