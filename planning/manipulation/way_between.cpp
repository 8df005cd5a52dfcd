#include "castor/planning/manipulation/way_between.hpp"

#include "castor/planning/manipulation/plan_scene.hpp"

#include <algorithm>
#include <numbers>
#include <utility>
#include <variant>

namespace castor::manipulation {

namespace {

using std::numbers::pi;

/// Stops to which no way is found, after which others are not tried: each takes seconds.
constexpr int most_without_way = 3;

/// Further turns of a thing about the vertical; what is round is the same from all sides.
std::vector<double> turns_of(const NamedSolid& thing) {
  return thing.solid.kind == SolidKind::box ? std::vector{0.0, pi / 4, pi / 8, 3 * pi / 8}
                                            : std::vector{0.0};
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
  for (const double turn : turns)
    for (const auto& place : places)
      stops_.push_back({between(place, turn)});
  // To where it can be turned.
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const double turn : turns)
      if (turn != 0)
        stops_.push_back({between(places[i], turn), i});
}

bool StopsBetween::are_for(const Scene& scene, const std::string& thing,
                           const Configuration& start) const {
  return scene == scene_ && thing == thing_ && start == start_;
}

std::optional<ManipulationPlan> StopsBetween::plan_to(const PlaceGoal& goal) {
  int without_way = 0;
  for (std::size_t i = 0; i < stops_.size() && without_way < most_without_way; ++i) {
    const auto& ways = ways_from(i);
    if (!ways || !planner_.landing_of(*ways, goal))
      continue;
    auto plan = planner_.pick_and_place(scene_, thing_, first_place(stops_[i]), start_);
    if (auto* found = std::get_if<ManipulationPlan>(&plan))
      return std::move(*found);
    ++without_way;
  }
  return {};
}

bool StopsBetween::reach(const PlaceGoal& goal) {
  for (std::size_t i = 0; i < stops_.size(); ++i)
    if (!stops_[i].before)
      if (const auto& ways = ways_from(i); ways && planner_.landing_of(*ways, goal))
        return true;
  return false;
}

const ManipulationPlanner::WaysToTake& StopsBetween::ways_from_here() {
  if (!here_)
    here_ = planner_.ways_to_take(scene_, thing_, start_);
  return *here_;
}

const PlaceGoal& StopsBetween::first_place(const Stop& stop) const {
  return stop.before ? stops_[*stop.before].place : stop.place;
}

const std::optional<ManipulationPlanner::WaysToTake>& StopsBetween::ways_from(std::size_t index) {
  auto& stop = stops_[index];
  if (std::exchange(stop.is_tried, true))
    return stop.ways;
  if (!stop.before)
    stop.ways = ways_from_place(ways_from_here(), stop.place);
  else if (const auto& ways = ways_from(*stop.before))
    stop.ways = ways_from_place(*ways, stop.place);
  return stop.ways;
}

std::optional<ManipulationPlanner::WaysToTake>
StopsBetween::ways_from_place(const ManipulationPlanner::WaysToTake& ways,
                              const PlaceGoal& place) const {
  const auto there = planner_.landing_of(ways, place);
  if (!there)
    return {};
  auto scene = scene_;
  std::ranges::find(scene.things, thing_, &NamedSolid::name)->pose = *there;
  return planner_.ways_to_take(scene, thing_, start_);
}

} // namespace castor::manipulation
