#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/exploration/exploration_planner.hpp"
#include "castor/mapping/exploration/types.hpp"
#include "castor/mapping/map_components/follows_grid.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

enum class AfterExploration { stay, end };
CASTOR_REFLECT_ENUM(AfterExploration, stay, end)

/// Executes `Explore`: lets the Navigator go to one frontier after the other.
class Explorer final : public FollowsGrid<UnmanagedComponent> {
  void start() override {
    ExplorationOptions options;
    options.floor.clearance = clearance_;
    options.floor.radius = radius_;
    options.frontiers.least_size = least_size_;
    options.frontiers.sight = sight_;
    options.aversion = aversion_;
    options.attempts = static_cast<int>(attempts_.get());
    planner_ = ExplorationPlanner(options);
    on_change(changed<RobotPose>().in(localisation_),
              [this](const ChangeEvent& event) { look_at_pose(event.address); });
    // It is not told again while the robot stands.
    for (auto& x : read_all_in<RobotPose>(localisation_.get()))
      take_pose(*x);
    follow_grid();
    on_action<Explore>(
      [this](ActionInProgress& action, const Explore& what) { return explore(action, what); });
  }

  void run() override {
    if (!begins_)
      return;
    // As an action, so that everybody sees it, and can cancel it. It fails with a component.
    for (auto outcome = ActionOutcome::failed; outcome == ActionOutcome::failed;) {
      const auto action = perform(subarchitecture(), Explore{});
      do
        if (!sleep_for(period_.get()))
          return;
      while (!action.is_over());
      const auto end = action.state();
      outcome = end.outcome;
      if (outcome == ActionOutcome::failed)
        warning("the exploration failed: {}; it begins again", end.reason);
    }
    if (after_ == AfterExploration::end)
      end_system(0, "the building is explored");
  }

  void grid_changed(const CellRegion&) override { is_new_ = true; }

  void look_at_pose(const Address& address) {
    try {
      take_pose(*read<RobotPose>(address));
    } catch (const DoesNotExistOnWM&) {
      debug("{} was deleted before it was read", address.id);
    }
  }

  void take_pose(const RobotPose& x) {
    if (x.state == LocalisationState::tracking || x.state == LocalisationState::dead_reckoning)
      pose_ = x.pose;
  }

  ActionResult explore(ActionInProgress& action, const Explore& what) {
    std::optional<Frontier> goal;
    ActionHandle movement;
    Timestamp quiet_since = now();
    while (action.sleep_for(period_.get())) {
      if (goal && movement.is_over()) {
        end_of(*goal, movement.state());
        goal.reset();
        movement = {};
        quiet_since = now();
        // The last scans reach the grid meanwhile.
        continue;
      }
      if (!pose_ || grid().map().cells.empty())
        continue;
      // A map that has just grown is looked at once, however many tiles came.
      if (std::exchange(is_new_, false) || !goal)
        planner_.look(grid().map(), *pose_);
      if (what.area > 0 && planner_.seen() >= what.area)
        return finished({});
      if (goal && planner_.is_open(*goal)) {
        tell(goal, false);
        continue;
      }
      const auto next = planner_.choose();
      if (next) {
        goal = next;
        movement = ActionHandle{};
        movement = perform(navigation_.get(), place_of(*goal));
        ++goals_;
        quiet_since = now();
      } else if (goal) {
        // It is seen already, and there is nothing else.
        goal.reset();
        movement = {};
      } else if (now() - quiet_since >= settling_.get()) {
        return finished(what_is_left());
      }
      tell(goal, false);
    }
    return ActionResult::cancelled();
  }

  static GoToPlace place_of(const Frontier& x) {
    GoToPlace result;
    result.x = x.view.x;
    result.y = x.view.y;
    result.heading = x.view.heading;
    result.has_heading = true;
    return result;
  }

  void end_of(const Frontier& goal, const Action& movement) {
    if (movement.outcome == ActionOutcome::succeeded)
      planner_.arrived(goal);
    else
      planner_.failed(goal,
                      movement.reason.empty() ? "the robot did not get there" : movement.reason);
  }

  /// What was not reached, for people.
  std::string what_is_left() const {
    std::string result;
    for (const auto& x : planner_.report(std::nullopt))
      result +=
        fmt::format("{}({:.1f}, {:.1f}): {}", result.empty() ? "" : "; ", x.x, x.y, x.reason);
    return result;
  }

  ActionResult finished(const std::string& left) {
    tell(std::nullopt, true);
    info("{:.1f} m2 are seen, {} goals{}", planner_.seen(), goals_,
         left.empty() ? "" : "; not reached: " + left);
    auto result = ActionResult::succeeded({"explored"});
    result.reason = left;
    return result;
  }

  /// Overwrites the entry about the exploration.
  void tell(const std::optional<Frontier>& goal, bool is_finished) {
    ExplorationState x;
    x.time = now().count();
    x.seen = planner_.seen();
    x.frontiers = planner_.report(goal);
    x.goals = goals_;
    x.finished = is_finished;
    put(here(component_name()), x);
  }

  Option<std::string> navigation_{this, "navigation", "navigation",
                                  "subarchitecture of the Navigator"};
  Option<SubarchitectureName> localisation_{this, "localisation", "slam",
                                            "whose RobotPose entries count"};
  Option<bool> begins_{this, "start", false, "it explores without being asked"};
  Option<AfterExploration> after_{this, "after", AfterExploration::stay,
                                  "what happens then: stay, or end the system"};
  Option<std::chrono::milliseconds> period_{this, "period", 500ms, "time between looks at the map"};
  Option<std::chrono::milliseconds> settling_{this, "settling", 3s,
                                              "it ends when nothing was reachable for so long"};
  Option<double> clearance_{this, "clearance", 0.3,
                            "of the robot's middle from what is occupied, metres"};
  Option<double> radius_{this, "radius", 0.25,
                         "of the robot's footprint: it looks for floor where that fits; metres"};
  Option<double> least_size_{this, "least-size", 0.2, "shorter frontiers do not count, metres"};
  Option<double> sight_{this, "sight", 4, "how far the robot sees into the unknown, metres"};
  Option<double> aversion_{this, "aversion", ExplorationOptions{}.aversion,
                           "how strongly the way counts against what is to be seen, 1/m"};
  Option<std::int64_t> attempts_{this, "attempts", 2, "how often it goes to a frontier at most"};

  ExplorationPlanner planner_;
  std::optional<Pose2> pose_;
  bool is_new_ = false;
  std::int64_t goals_ = 0;
};

CASTOR_COMPONENT(Explorer, "lets the robot see all of a building that it can reach")

} // namespace

} // namespace castor::mapping
