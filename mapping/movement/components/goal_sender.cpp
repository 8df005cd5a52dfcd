#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/body/footprint.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/movement/footprint_room.hpp"
#include "castor/mapping/movement/goal_tally.hpp"
#include "castor/mapping/movement/path_planner.hpp"
#include "castor/mapping/movement/planning_map.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

enum class AfterGoals { stay, end };
CASTOR_REFLECT_ENUM(AfterGoals, stay, end)

/// Of which cells of the map goals are drawn: where the robot fits with its margin, or of any that
/// is free, or --count of each.
enum class GoalCells { fitting, free, both };
CASTOR_REFLECT_ENUM(GoalCells, fitting, free, both)

/// Asks a Navigator for goals, one after the other, and says how it went.
class GoalSender final : public UnmanagedComponent {
  void configure() override {
    if (!goals_text_->empty()) {
      auto read = parse_path(goals_text_.get(), "--goals");
      if (has_errors(read.problems))
        throw TextFileError(read.problems);
      goals_ = std::move(read.path);
    }
    options_.radius = radius_;
    options_.margin = margin_;
    if (!outline_->empty()) {
      footprint_ = parse_footprint(outline_.get(), "--footprint");
      options_.radius = footprint_->inner_radius();
    }
    if (!map_file_->empty())
      map_.update(read_map_server(file_named(map_file_, base_.get())), 0);
    if (goals_.empty())
      draw_goals();
    else
      kinds_.assign(goals_.size(), GoalCells::free);
  }

  bool has_map() const { return map_.version().has_value(); }

  void draw_goals() {
    if (!has_map())
      throw std::invalid_argument("there is no goal: name some with --goals \"X Y, X Y\", or a map "
                                  "with --map, of which --count are drawn");
    std::mt19937_64 random(static_cast<std::uint64_t>(seed_.get()));
    for (const auto kind : {GoalCells::fitting, GoalCells::free})
      if (cells_ == kind || cells_ == GoalCells::both)
        draw_goals(kind, random);
  }

  /// Centres of cells.
  void draw_goals(GoalCells kind, std::mt19937_64& random) {
    const auto& cells = map_.cells().cells;
    std::vector<std::size_t> choice;
    std::optional<FootprintRoom> room;
    if (footprint_)
      room.emplace(map_.clearance(), *footprint_, options_.margin);
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (cells[i] >= 0 && cells[i] < options_.cells.occupied_from &&
          (kind == GoalCells::free || fits(i, room)))
        choice.push_back(i);
    if (choice.empty())
      throw std::invalid_argument(
        kind == GoalCells::free ? "--map: no cell of it is free; choose another map"
                                : "--map: the robot fits nowhere in it; choose another map, or a "
                                  "smaller --radius");
    for (int i = 0; i < count_; ++i) {
      goals_.push_back(map_.clearance().centre(choice[random() % choice.size()]));
      kinds_.push_back(kind);
    }
  }

  /// Whether the robot can be in that cell of the map, as it faces somewhere.
  bool fits(std::size_t cell, const std::optional<FootprintRoom>& room) const {
    const auto& clearance = map_.clearance();
    if (clearance.at(cell) < options_.radius + options_.margin)
      return false;
    if (!room)
      return true;
    const auto place = clearance.centre(cell);
    constexpr int directions = 24;
    for (int i = 0; i < directions; ++i)
      if (room->at({place.x, place.y, 2 * std::numbers::pi * i / directions}) > 0)
        return true;
    return false;
  }

  Reachability reachability(const Point2& start, const Point2& goal) const {
    std::optional<double> sure;
    if (footprint_)
      sure = footprint_->outer_radius() + options_.margin;
    return ReachabilityCheck(map_.cells(), start, options_.radius + options_.margin, sure).of(goal);
  }

  void start() override {
    on_push<BodyStatus>(robot_, [this](auto& x) { status_ = *x; });
    on_change(changed<Movement>().in(navigation_), [this](const ChangeEvent& event) {
      try {
        const auto x = read<Movement>(event.address);
        if (x->plans > 0 && x->plans != plans_)
          tallies_[kind_].add_plan(x->planning_time);
        plans_ = x->plans;
        movement_ = *x;
      } catch (const DoesNotExistOnWM&) {
        debug("{} was deleted before it was read", event.address.id);
      }
    });
  }

  void run() override {
    while (is_running() && !status_)
      sleep_for(100ms);
    for (std::size_t i = 0; i < goals_.size() && is_running(); ++i)
      ask(i);
    if (!is_running())
      return;
    for (const auto& [kind, tally] : tallies_)
      info("{}{}", kind == GoalCells::fitting ? "where the robot fits: " : "", tally.text());
    if (after_ == AfterGoals::end)
      end_system(0, "all goals were asked for");
  }

  void ask(std::size_t number) {
    const auto& goal = goals_[number];
    const auto begin = *status_;
    const Point2 start{begin.pose.x, begin.pose.y};
    GoalOutcome x;
    if (has_map()) {
      x.shortest = shortest(start, goal);
      x.reachability = reachability(start, goal);
    }
    kind_ = kinds_[number];
    // Each action counts its plans anew.
    plans_ = 0;
    movement_ = {};
    GoToPlace what;
    what.x = goal.x;
    what.y = goal.y;
    const auto over = perform(navigation_.get(), what).wait();
    // The last Movement entry and BodyStatus arrive meanwhile.
    sleep_for(200ms);
    x.is_reached = over.outcome == ActionOutcome::succeeded;
    x.driven = status_->driven - begin.driven;
    x.waited = movement_.waited;
    x.recoveries = movement_.recoveries;
    x.collisions = status_->collisions - begin.collisions;
    tallies_[kind_].add(x);
    if (x.is_reached)
      info("goal {} at {:.2f} {:.2f}: reached, {:.2f} m from it, {:.1f} m driven in {:.1f} s",
           number + 1, goal.x, goal.y, distance(Point2{status_->pose.x, status_->pose.y}, goal),
           x.driven, static_cast<double>(status_->time - begin.time) / 1e6);
    else
      info("goal {} at {:.2f} {:.2f}: {}{}", number + 1, goal.x, goal.y, over.reason,
           x.reachability == Reachability::reachable ? "; yet the map has a way" : "");
  }

  /// Length of the shortest way with the robot's clearance, if there is one on the map.
  std::optional<double> shortest(const Point2& start, const Point2& goal) const {
    auto options = options_;
    options.narrowness = 0;
    options.explains = false;
    const auto plan = plan_path(map_.cells(), map_.clearance(), start, goal, options);
    return plan.points.empty() ? std::nullopt : std::optional{plan.length};
  }

  Option<std::string> goals_text_{this, "goals", "",
                                  "X Y, X Y, ..., metres; empty: drawn of --map"};
  Option<std::string> map_file_{
    this, "map", "", "a .yaml of map_server, for drawing goals and for the shortest ways"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<int> count_{this, "count", 50, "how many goals are drawn, of each kind of cells"};
  Option<GoalCells> cells_{this, "cells", GoalCells::both,
                           "of which cells: fitting (the robot fits there), free, or both"};
  Option<double> radius_{this, "radius", PlanOptions{}.radius, "as of the Navigator, metres"};
  Option<std::string> outline_{this, "footprint", "",
                               "as of the Navigator, in place of --radius; empty: a disc"};
  Option<double> margin_{this, "margin", PlanOptions{}.margin, "as of the Navigator, metres"};
  Option<std::int64_t> seed_{this, "seed", 1, "of the goals that are drawn"};
  Option<SubarchitectureName> navigation_{this, "navigation", "navigation",
                                          "subarchitecture of the Navigator"};
  Option<StandaloneName> robot_{this, "robot", "robot", "whose true path and collisions count"};
  Option<AfterGoals> after_{this, "after", AfterGoals::end,
                            "what it does then: stay, or end the system"};

  PlanOptions options_;
  std::optional<Footprint> footprint_;
  PlanningMap map_;
  Path goals_;
  /// Of each goal.
  std::vector<GoalCells> kinds_;
  GoalCells kind_ = GoalCells::free;
  std::map<GoalCells, GoalTally> tallies_;
  std::optional<BodyStatus> status_;
  Movement movement_;
  std::int64_t plans_ = 0;
};

CASTOR_COMPONENT(GoalSender, "asks a Navigator for goals, and says how it went")

} // namespace

} // namespace castor::mapping
