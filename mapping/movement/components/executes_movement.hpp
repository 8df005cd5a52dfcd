#pragma once

#include "castor/actors/component/actions.hpp"
#include "castor/mapping/body/seen_obstacles.hpp"
#include "castor/mapping/movement/components/has_movement_options.hpp"
#include "castor/mapping/movement/movement_queue.hpp"
#include "castor/mapping/movement/mover_watch.hpp"
#include "castor/mapping/movement/person_follower.hpp"
#include "castor/mapping/movement/types.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

/// A component that moves the robot: what actions of movement share. One that derives from it says
/// in `start()` which actions it executes.
class ExecutesMovement : public HasMovementOptions {
protected:
  void start() override {
    follow_pose();
    on_push<Odometry>(sensors(), [this](auto& x) { watch_.add(*x); });
    on_push<LaserScan>(sensors(), [this](auto& x) {
      watch_.add(*x);
      if (pose())
        seen_.add(*x, *pose());
    });
    planning_map_ = PlanningMap(pursuit_options().plan.cells);
    if (!given_map())
      follow_grid();
    on_change(
      added<Action>().anywhere().where(field(&Action::subarchitecture) == subarchitecture()),
      [this](const ChangeEvent& event) { note_action(event.address); });
  }

  void run() override {
    take_seat();
    has_seat_ = true;
    while (is_running())
      wait_for_changes();
    drive({});
    leave_seat();
  }

  void grid_changed(const CellRegion&) override {}

  // -- actions

  /// Executes actions of that type, one after the other.
  /// @param handler gets the action and what it is about
  template <class T, class F>
  void execute(F handler) {
    priorities_[type_name<T>()] = [this](const Address& what) { return read<T>(what)->priority; };
    on_action<T>([this, handler](ActionInProgress& action, const T& what) {
      if (!queue_.begin(action.address()))
        return ActionResult::cancelled("an urgent action has cleared the queue");
      auto result = handler(action, what);
      if (queue_.is_cleared())
        result = ActionResult::cancelled("an urgent action has cleared the queue");
      queue_.end();
      return result;
    });
  }

  /// Calls `step` each period until it says how the action has ended, and as soon as nothing that
  /// it needs is missing. The robot stands otherwise.
  template <class F>
  ActionResult execute_steps(ActionInProgress& action, const std::string& task, F step) {
    movement_ = {};
    movement_.task = task;
    while (!queue_.is_cleared() && !action.cancelled()) {
      if (const auto missing = what_is_missing(); !missing.empty()) {
        drive({});
        movement_.waited += std::chrono::duration<double>(period()).count();
        tell(MovementStatus::waiting, missing);
      } else if (const std::optional<ActionResult> end = step()) {
        drive({});
        movement_.reason = end->reason;
        tell(end->outcome == ActionOutcome::succeeded ? MovementStatus::arrived
                                                      : MovementStatus::failed,
             {}, true);
        return *end;
      }
      action.sleep_for(period());
    }
    drive({});
    movement_.reason =
      queue_.is_cleared() ? "an urgent action has cleared the queue" : "it was cancelled";
    tell(MovementStatus::cancelled, {}, true);
    return ActionResult::cancelled();
  }

  struct Route {
    /// Places to pass, and the last one to go to.
    std::vector<Point2> places;
    /// To face there, radians.
    std::optional<double> heading;
    /// Why there is none; empty if there is one.
    std::string reason;
  };

  /// Goes along a route.
  /// @param find_route is called once, when it is known where the robot is, and there is a map
  template <class F>
  ActionResult go(ActionInProgress& action, const std::string& task, F find_route) {
    std::optional<Route> route;
    std::size_t leg = 0;
    std::unique_ptr<Pursuit> pursuit;
    // Of the legs before.
    Movement before;
    return execute_steps(action, task, [&]() -> std::optional<ActionResult> {
      if (!route)
        route = find_route();
      if (!route->reason.empty())
        return ActionResult::failed(route->reason);
      const auto& places = route->places;
      if (!pursuit) {
        pursuit = leg_to(*route, leg);
        movement_.goal = {places[leg].x, places[leg].y, route->heading.value_or(0)};
      }
      const int plans = pursuit->plans();
      const auto end = step_of(*pursuit);
      note(*pursuit, before, pursuit->plans() != plans);
      if (pursuit->length() > 0)
        action.progress(
          (static_cast<double>(leg) + std::min(1.0, pursuit->done() / pursuit->length())) /
          static_cast<double>(places.size()));
      if (!end || end->outcome != ActionOutcome::succeeded || ++leg == places.size())
        return end;
      before = movement_;
      pursuit.reset();
      return std::nullopt;
    });
  }

  /// Turns on the spot, by more than a full turn too.
  ActionResult turn(ActionInProgress& action, double angle, const std::string& task) {
    if (planner() == PlannerKind::reeds_shepp)
      return ActionResult::failed("the robot cannot turn on the spot");
    std::optional<double> before;
    double left = angle;
    return execute_steps(action, task, [&]() -> std::optional<ActionResult> {
      if (before)
        left -= normalised(pose()->heading - *before);
      before = pose()->heading;
      constexpr double close = 0.03; // radians
      if (std::abs(left) < close)
        return ActionResult::succeeded();
      if (!can_turn(*pose(), left, planning_map(), seen_.points()))
        return ActionResult::failed("the robot's footprint would touch something by that turn");
      const double most = pursuit_options().follow.max_turn;
      drive({0, std::clamp(2 * left, -most, most)});
      tell(MovementStatus::moving, {});
      action.progress(std::clamp(1 - left / angle, 0.0, 1.0));
      return std::nullopt;
    });
  }

  /// Follows a person until it is cancelled, or the person is lost.
  /// @param people in sight now, as a function
  template <class F>
  ActionResult follow(ActionInProgress& action, const FollowPerson& what, F people) {
    if (planner() != PlannerKind::grid)
      return ActionResult::failed(
        "only a robot that is a disc follows people: leave --planner out");
    std::optional<PersonFollower> follower;
    return execute_steps(action, "follow a person", [&]() -> std::optional<ActionResult> {
      const std::vector<SeenPerson> in_sight = people();
      if (!follower) {
        const auto id = what.person != 0 ? what.person : nearest_of(in_sight, *pose());
        if (id == 0) {
          drive({});
          tell(MovementStatus::waiting, "somebody to follow");
          return std::nullopt;
        }
        follower.emplace(id, follow_options(what.distance));
      }
      const auto seen = seen_.points();
      const auto movers = watch_.movers(*pose());
      const auto step =
        follower->step(now().count(), *pose(), in_sight, {planning_map(), seen, movers, gateways_});
      movement_.task = "follow person " + std::to_string(follower->person());
      drive(step.velocity);
      if (step.status == MovementStatus::failed)
        return ActionResult::failed(step.reason);
      tell(step.status, step.waits_for);
      return std::nullopt;
    });
  }

  // -- what it knows

  /// Whether there are cells.
  bool has_map() const { return map().columns > 0; }

  /// The map of now, or of half a second ago: the grid changes tile by tile.
  const PlanningMap& planning_map() {
    using namespace std::chrono_literals;
    if (!planning_map_.version() || now() - map_updated_ >= 500ms) {
      planning_map_.update(map(), given_map() ? 0 : grid().version());
      map_updated_ = now();
    }
    return planning_map_;
  }

  /// Middles of doors, where the robot drives slowly.
  std::vector<Point2> gateways_;

private:
  /// Id of the person nearest to the robot; 0 if there is nobody.
  static std::int64_t nearest_of(const std::vector<SeenPerson>& people, const Pose2& robot) {
    const auto nearest = std::ranges::min_element(people, {}, [&](const SeenPerson& x) {
      return distance(x.place, {robot.x, robot.y});
    });
    return nearest == people.end() ? 0 : nearest->id;
  }

  /// An urgent action clears the queue when it arrives, not when its turn comes.
  void note_action(const Address& address) {
    try {
      const auto x = read<Action>(address);
      const auto priority = priorities_.find(x->what.type);
      if (priority != priorities_.end())
        queue_.arrive(address, priority->second(x->what.address));
    } catch (const DoesNotExistOnWM&) {
      debug("{} was deleted before it was read", address.id);
    }
  }

  std::unique_ptr<Pursuit> leg_to(const Route& route, std::size_t leg) const {
    const bool is_last = leg + 1 == route.places.size();
    return new_pursuit(route.places[leg], is_last ? route.heading : std::nullopt, is_last);
  }

  /// How the pursuit has ended, if it has.
  std::optional<ActionResult> step_of(Pursuit& pursuit) {
    const int plans = pursuit.plans();
    const auto seen = seen_.points();
    const auto movers = watch_.movers(*pose());
    const auto& map = planning_map();
    const auto begun = std::chrono::steady_clock::now();
    const auto step = pursuit.step(now().count(), *pose(), {map, seen, movers, gateways_});
    if (pursuit.plans() != plans)
      movement_.planning_time =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    drive(step.velocity);
    if (step.status == MovementStatus::arrived)
      return ActionResult::succeeded();
    if (step.status == MovementStatus::failed)
      return ActionResult::failed(step.reason);
    tell(step.status, step.waits_for, pursuit.plans() != plans);
    return std::nullopt;
  }

  /// What it needs in order to move and does not have; empty if there is nothing.
  std::string what_is_missing() const {
    if (!has_seat_)
      return "the driver's seat";
    if (is_lost())
      return "localisation: " + lost_reason();
    if (!pose())
      return "a pose";
    if (!has_map())
      return "a map";
    return {};
  }

  const CellMap& map() const { return given_map() ? *given_map() : grid().map(); }

  void note(const Pursuit& pursuit, const Movement& before, bool is_new_path) {
    movement_.done = pursuit.done();
    movement_.length = pursuit.length();
    movement_.plans = before.plans + pursuit.plans();
    movement_.recoveries = before.recoveries + pursuit.recoveries();
    movement_.waited = before.waited + static_cast<double>(pursuit.waited()) / 1e6;
    if (!is_new_path)
      return;
    movement_.path.clear();
    auto& path = pursuit.path();
    for (std::size_t i = 0; i < path.size(); ++i) {
      const auto& next = path[std::min(i + 1, path.size() - 1)];
      movement_.path.push_back(
        {path[i].x, path[i].y, std::atan2(next.y - path[i].y, next.x - path[i].x)});
    }
  }

  /// Overwrites the entry of what it does: on a change, and each second.
  void tell(MovementStatus status, const std::string& waits_for, bool at_once = false) {
    using namespace std::chrono_literals;
    const bool is_news = status != movement_.status || waits_for != movement_.waits_for;
    if (!is_news && !at_once && now() - told_ < 1s)
      return;
    told_ = now();
    movement_.status = status;
    movement_.waits_for = waits_for;
    movement_.time = told_.count();
    put(here(component_name()), movement_);
  }

  PlanningMap planning_map_;
  Timestamp map_updated_{0};
  SeenObstacles seen_;
  MoverWatch watch_;
  bool has_seat_ = false;
  MovementQueue queue_;
  /// Of an action, by the type of its specific entry.
  std::map<std::string, std::function<MovementPriority(const Address&)>> priorities_;
  Movement movement_;
  Timestamp told_{0};
};

} // namespace castor::mapping
