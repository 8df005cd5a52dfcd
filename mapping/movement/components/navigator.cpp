#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/mapping/body/components/drives_by_pose.hpp"
#include "castor/mapping/body/seen_obstacles.hpp"
#include "castor/mapping/map_components/follows_grid.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/movement/goal_pursuit.hpp"
#include "castor/mapping/movement/mover_watch.hpp"
#include "castor/mapping/movement/types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Moves the robot: executes the actions of movement, one after the other.
class Navigator final : public FollowsGrid<DrivesByPose> {
public:
  Navigator() : FollowsGrid(PoseSource::localisation) {
    // nop
  }

private:
  void configure() override {
    if (!map_file_->empty())
      map_ = read_map_server(file_named(map_file_, base_.get()));
    options_.plan.radius = radius_;
    options_.plan.margin = margin_;
    options_.plan.preferred_clearance = preferred_clearance_;
    options_.plan.cells.unknown_is_obstacle = !through_unknown_;
    options_.follow.speed = speed_;
    options_.follow.look_ahead = look_ahead_;
    options_.follow.tolerance = tolerance_;
    options_.braking = braking_;
    options_.gap = gap_;
    options_.narrow_speed = narrow_speed_;
    options_.patience = std::chrono::duration_cast<Timestamp>(patience_.get()).count();
    options_.recoveries = recoveries_;
    planning_map_ = PlanningMap(options_.plan.cells);
  }

  void start() override {
    follow_pose();
    on_push<Odometry>(sensors(), [this](auto& x) { watch_.add(*x); });
    on_push<LaserScan>(sensors(), [this](auto& x) {
      watch_.add(*x);
      if (pose())
        seen_.add(*x, *pose());
    });
    if (map_file_->empty())
      follow_grid();
    on_change(
      added<Action>().anywhere().where(field(&Action::subarchitecture) == subarchitecture()),
      [this](const ChangeEvent& event) { note_action(event.address); });
    execute<GoToPlace>([this](ActionInProgress& action, const GoToPlace& x) {
      return go(action, {x.x, x.y}, x.has_heading ? std::optional{x.heading} : std::nullopt,
                fmt::format("go to {:.2f} {:.2f}", x.x, x.y));
    });
    execute<GoToObject>(
      [this](ActionInProgress& action, const GoToObject& x) { return go_near(action, x); });
    execute<TurnBy>([this](ActionInProgress& action, const TurnBy& x) {
      return turn(action, x.angle, fmt::format("turn by {:.2f} rad", x.angle));
    });
    execute<TurnTo>([this](ActionInProgress& action, const TurnTo& x) {
      const double angle = pose() ? normalised(x.heading - pose()->heading) : 0;
      return turn(action, angle, fmt::format("turn to {:.2f} rad", x.heading));
    });
    execute<StopMoving>([this](ActionInProgress&, const StopMoving&) {
      drive({});
      return ActionResult::succeeded();
    });
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

  // -- the order of actions

  template <class T, class F>
  void execute(F handler) {
    on_action<T>([this, handler](ActionInProgress& action, const T& x) {
      std::erase(arrived_, action.address());
      if (cleared_.erase(action.address()) > 0)
        return ActionResult::cancelled("an urgent action has cleared the queue");
      runs_ = action.address();
      auto result = handler(action, x);
      if (is_cleared_)
        result = ActionResult::cancelled("an urgent action has cleared the queue");
      runs_.reset();
      is_cleared_ = false;
      return result;
    });
  }

  /// An urgent action clears the queue when it arrives, not when its turn comes.
  void note_action(const Address& address) {
    try {
      const auto x = read<Action>(address);
      if (is_urgent(x->what)) {
        cleared_.insert(arrived_.begin(), arrived_.end());
        arrived_.clear();
        is_cleared_ = runs_.has_value();
      }
      if (runs_ != address)
        arrived_.push_back(address);
    } catch (const DoesNotExistOnWM&) {
      debug("{} was deleted before it was read", address.id);
    }
  }

  bool is_urgent(const AnyEntryPointer& what) {
    auto of = [&]<class T>(std::optional<T>) {
      return what.type == type_name<T>() &&
             read<T>(what.address)->priority == MovementPriority::urgent;
    };
    return of(std::optional<GoToPlace>{}) || of(std::optional<GoToObject>{}) ||
           of(std::optional<TurnBy>{}) || of(std::optional<TurnTo>{}) ||
           what.type == type_name<StopMoving>();
  }

  bool must_end(ActionInProgress& action) { return is_cleared_ || action.cancelled(); }

  // -- actions

  ActionResult go(ActionInProgress& action, const Point2& goal, std::optional<double> heading,
                  const std::string& task) {
    GoalPursuit pursuit(goal, heading, options_);
    movement_ = {};
    movement_.task = task;
    movement_.goal = {goal.x, goal.y, heading.value_or(0)};
    int told_plans = 0;
    while (!must_end(action)) {
      if (const auto missing = what_is_missing(); !missing.empty()) {
        drive({});
        movement_.waited += in_seconds(period_);
        tell(MovementStatus::waiting, missing);
      } else {
        const auto begun = std::chrono::steady_clock::now();
        const auto seen = seen_.points();
        const auto movers = watch_.movers(*pose());
        const auto step = pursuit.step(now().count(), *pose(), {planning_map(), seen, movers});
        if (pursuit.plans() != told_plans)
          movement_.planning_time =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        drive(step.velocity);
        const bool is_new = pursuit.plans() != std::exchange(told_plans, pursuit.plans());
        note(pursuit, is_new);
        if (step.status == MovementStatus::arrived || step.status == MovementStatus::failed) {
          movement_.reason = step.reason;
          tell(step.status, {}, true);
          return step.status == MovementStatus::arrived ? ActionResult::succeeded()
                                                        : ActionResult::failed(step.reason);
        }
        tell(step.status, step.waits_for, is_new);
        if (pursuit.length() > 0)
          action.progress(std::min(1.0, pursuit.done() / pursuit.length()));
      }
      action.sleep_for(period_.get());
    }
    return stopped();
  }

  /// To the place around the object that takes the shortest way.
  ActionResult go_near(ActionInProgress& action, const GoToObject& x) {
    if (!pose())
      return ActionResult::failed("it is not known where the robot is");
    const auto& map = planning_map();
    auto options = options_.plan;
    options.explains = false;
    std::optional<Pose2> best;
    double shortest = std::numeric_limits<double>::infinity();
    std::string reason;
    constexpr int directions = 16;
    for (int i = 0; i < directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / directions;
      const Point2 place{x.x + x.distance * std::cos(angle), x.y + x.distance * std::sin(angle)};
      const auto plan =
        plan_path(map.cells(), map.clearance(), {pose()->x, pose()->y}, place, options);
      if (plan.points.empty()) {
        reason = plan.reason;
      } else if (plan.length < shortest) {
        shortest = plan.length;
        best = Pose2{place.x, place.y, normalised(angle + std::numbers::pi)};
      }
    }
    if (!best)
      return ActionResult::failed(
        fmt::format("no place {:.2f} m from the object can be reached: {}", x.distance, reason));
    return go(action, {best->x, best->y}, best->heading,
              fmt::format("go near {:.2f} {:.2f}", x.x, x.y));
  }

  ActionResult turn(ActionInProgress& action, double angle, const std::string& task) {
    movement_ = {};
    movement_.task = task;
    std::optional<double> before;
    double left = angle;
    constexpr double close = 0.03; // radians
    while (!must_end(action)) {
      if (const auto missing = what_is_missing(); !missing.empty()) {
        drive({});
        tell(MovementStatus::waiting, missing);
      } else {
        if (before)
          left -= normalised(pose()->heading - *before);
        before = pose()->heading;
        if (std::abs(left) < close) {
          drive({});
          tell(MovementStatus::arrived, {}, true);
          return ActionResult::succeeded();
        }
        const double most = options_.follow.max_turn;
        drive({0, std::clamp(2 * left, -most, most)});
        tell(MovementStatus::moving, {});
        action.progress(std::clamp(1 - left / angle, 0.0, 1.0));
      }
      action.sleep_for(period_.get());
    }
    return stopped();
  }

  ActionResult stopped() {
    drive({});
    movement_.reason = is_cleared_ ? "an urgent action has cleared the queue" : "it was cancelled";
    tell(MovementStatus::cancelled, {}, true);
    return ActionResult::cancelled();
  }

  /// What it needs in order to move and does not have; empty if there is nothing.
  std::string what_is_missing() const {
    if (!has_seat_)
      return "the driver's seat";
    if (is_lost())
      return "localisation: " + lost_reason();
    if (!pose())
      return "a pose";
    if (map().columns == 0)
      return "a map";
    return {};
  }

  const CellMap& map() const { return map_ ? *map_ : grid().map(); }

  /// The map of now, or of half a second ago: the grid changes tile by tile.
  const PlanningMap& planning_map() {
    if (!planning_map_.version() || now() - map_updated_ >= 500ms) {
      planning_map_.update(map(), map_ ? 0 : grid().version());
      map_updated_ = now();
    }
    return planning_map_;
  }

  static double in_seconds(std::chrono::milliseconds x) {
    return std::chrono::duration<double>(x).count();
  }

  void note(const GoalPursuit& pursuit, bool is_new_path) {
    movement_.done = pursuit.done();
    movement_.length = pursuit.length();
    movement_.plans = pursuit.plans();
    movement_.recoveries = pursuit.recoveries();
    movement_.waited = static_cast<double>(pursuit.waited()) / 1e6;
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
    const bool is_news = status != movement_.status || waits_for != movement_.waits_for;
    if (!is_news && !at_once && now() - told_ < 1s)
      return;
    told_ = now();
    movement_.status = status;
    movement_.waits_for = waits_for;
    movement_.time = told_.count();
    put(here(component_name()), movement_);
  }

  Option<std::string> map_file_{this, "map", "",
                                "a .yaml of map_server in place of the grid's tiles"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<bool> through_unknown_{this, "through-unknown", false,
                                "whether it plans through cells that nobody has seen"};
  Option<double> radius_{this, "radius", 0.25, "of the robot's footprint, metres"};
  Option<double> margin_{this, "margin", 0.05, "to keep from obstacles of the map, metres"};
  Option<double> preferred_clearance_{this, "preferred-clearance", 0.6,
                                      "where there is less, a way counts as longer; metres"};
  Option<double> gap_{this, "gap", 0.03, "to keep from what the laser sees, metres"};
  Option<double> speed_{this, "speed", 0.5, "m/s"};
  Option<double> narrow_speed_{this, "narrow-speed", 0.35, "in doors and narrow places, m/s"};
  Option<double> braking_{this, "braking", 0.4, "how hard it counts on braking, m/s^2"};
  Option<double> look_ahead_{this, "look-ahead", 0.3, "how far ahead on the path it aims, metres"};
  Option<double> tolerance_{this, "tolerance", 0.1,
                            "distance from the goal at which it has arrived, metres"};
  Option<std::chrono::milliseconds> patience_{this, "patience", 30s,
                                              "it gives up when every way was blocked for so long"};
  Option<int> recoveries_{this, "recoveries", 5, "it gives up after so many"};
  Option<std::chrono::milliseconds> period_{this, "period", 50ms, "time between commands"};

  PursuitOptions options_;
  std::optional<CellMap> map_;
  PlanningMap planning_map_;
  Timestamp map_updated_{0};
  SeenObstacles seen_;
  MoverWatch watch_;
  bool has_seat_ = false;
  /// Actions that were asked for and have not begun, and those of them that are not to begin.
  std::deque<Address> arrived_;
  std::set<Address> cleared_;
  std::optional<Address> runs_;
  bool is_cleared_ = false;
  Movement movement_;
  Timestamp told_{0};
};

CASTOR_COMPONENT(Navigator, "moves the robot: goes to places, turns, stops")

} // namespace

} // namespace castor::mapping
