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
    for (const double turn : turns_)
      for (const auto& place : places)
        if (auto plan = plan_to(between(place, turn), [&](const Pose& there) {
              return landing(there, goal_).has_value();
            }))
          return plan;
    // To where it can be turned.
    for (const auto& place : places)
      if (auto plan = plan_to(between(place, 0), [&](const Pose& there) {
            return std::ranges::any_of(turns_, [&](double turn) {
              const auto turned = turn == 0 ? std::nullopt : landing(there, between(place, turn));
              return turned && landing(*turned, goal_);
            });
          }))
        return plan;
    return {};
  }

private:
  static PlaceGoal between(const Point3& place, double turn) {
    return {place, 0, "the table", "a place between", turn};
  }

  /// From where the thing would be.
  std::optional<Pose> landing(const Pose& from, const PlaceGoal& goal) const {
    auto scene = scene_;
    std::ranges::find(scene.things, thing_, &NamedSolid::name)->pose = from;
    return planner_.landing_of(scene, thing_, goal, start_);
  }

  /// If it can go on from there.
  template <class F>
  std::optional<ManipulationPlan> plan_to(const PlaceGoal& place, F goes_on) const {
    const auto there = planner_.landing_of(scene_, thing_, place, start_);
    if (!there || !goes_on(*there))
      return {};
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
