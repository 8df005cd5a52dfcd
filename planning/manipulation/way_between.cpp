#include "castor/planning/manipulation/way_between.hpp"

#include "castor/planning/manipulation/plan_scene.hpp"

#include <algorithm>
#include <numbers>
#include <utility>
#include <variant>

namespace castor::manipulation {

namespace {

using std::numbers::pi;

/// Further turns of a thing about the vertical; what is round is the same from all sides.
std::vector<double> turns_of(const NamedSolid& thing) {
  return thing.solid.kind == SolidKind::box ? std::vector{0.0, pi / 4, pi / 8, 3 * pi / 8}
                                            : std::vector{0.0};
}

class WayBetween {
public:
  WayBetween(const ManipulationPlanner& planner, const Scene& scene, std::string thing,
             const PlaceGoal& goal, const Configuration& start)
    : planner_(planner), scene_(scene), thing_(std::move(thing)), goal_(goal), start_(start),
      turns_(turns_of(named(scene, thing_))) {
    // nop
  }

  std::optional<ManipulationPlan> run(const std::vector<Point3>& places) const {
    const auto here = planner_.ways_to_take(scene_, thing_, start_);
    std::vector<Stop> unturned;
    for (const double turn : turns_)
      for (const auto& place : places) {
        auto stop = stop_at(here, between(place, turn));
        if (!stop)
          continue;
        if (planner_.landing_of(stop->ways, goal_))
          if (auto plan = plan_to(stop->place))
            return plan;
        if (turn == 0)
          unturned.push_back(*std::move(stop));
      }
    // To where it can be turned.
    for (const auto& stop : unturned)
      if (std::ranges::any_of(turns_, [&](double turn) { return goes_on_turned(stop, turn); }))
        if (auto plan = plan_to(stop.place))
          return plan;
    return {};
  }

private:
  /// A place where the thing can be put down, and the ways to take it there.
  struct Stop {
    PlaceGoal place;
    ManipulationPlanner::WaysToTake ways;
  };

  static PlaceGoal between(const Point3& place, double turn) {
    return {place, 0, "the table", "a place between", turn};
  }

  std::optional<Stop> stop_at(const ManipulationPlanner::WaysToTake& ways,
                              const PlaceGoal& place) const {
    const auto there = planner_.landing_of(ways, place);
    if (!there)
      return {};
    auto scene = scene_;
    std::ranges::find(scene.things, thing_, &NamedSolid::name)->pose = *there;
    return Stop{place, planner_.ways_to_take(scene, thing_, start_)};
  }

  bool goes_on_turned(const Stop& stop, double turn) const {
    if (turn == 0)
      return false;
    const auto turned = stop_at(stop.ways, between(stop.place.bottom, turn));
    return turned && planner_.landing_of(turned->ways, goal_);
  }

  std::optional<ManipulationPlan> plan_to(const PlaceGoal& place) const {
    auto plan = planner_.pick_and_place(scene_, thing_, place, start_);
    if (auto* found = std::get_if<ManipulationPlan>(&plan))
      return std::move(*found);
    return {};
  }

  const ManipulationPlanner& planner_;
  const Scene& scene_;
  std::string thing_;
  const PlaceGoal& goal_;
  const Configuration& start_;
  std::vector<double> turns_;
};

} // namespace

std::optional<ManipulationPlan> plan_way_between(const ManipulationPlanner& planner,
                                                 const Scene& scene, const std::string& thing,
                                                 const PlaceGoal& goal,
                                                 const std::vector<Point3>& places,
                                                 const Configuration& start) {
  return WayBetween(planner, scene, thing, goal, start).run(places);
}

} // namespace castor::manipulation
