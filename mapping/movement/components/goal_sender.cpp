#include "castor/actors/component/action_types.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/movement/path_planner.hpp"
#include "castor/mapping/movement/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

double quantile(std::vector<double> values, double share) {
  if (values.empty())
    return 0;
  std::ranges::sort(values);
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(share * last))];
}

/// Asks a Navigator for goals, one after the other, and says how it went.
class GoalSender final : public UnmanagedComponent {
  void configure() override {
    if (!goals_text_->empty()) {
      auto read = parse_path(goals_text_.get(), "--goals");
      if (has_errors(read.problems))
        throw TextFileError(read.problems);
      goals_ = std::move(read.path);
    }
    if (!map_file_->empty())
      map_ = read_map_server(file_named(map_file_, base_.get()));
    if (goals_.empty())
      draw_goals();
  }

  /// Centres of free cells of the map, whether the robot fits there or not.
  void draw_goals() {
    if (!map_)
      throw std::invalid_argument("there is no goal: name some with --goals \"X Y, X Y\", or a map "
                                  "with --map, of which --count are drawn");
    PlanOptions options;
    const ClearanceMap clearance(*map_, options.cells);
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < map_->cells.size(); ++i)
      if (map_->cells[i] >= 0 && map_->cells[i] < options.cells.occupied_from)
        free.push_back(i);
    if (free.empty())
      throw std::invalid_argument("--map: no cell of it is free");
    std::mt19937_64 random(static_cast<std::uint64_t>(seed_.get()));
    for (int i = 0; i < count_; ++i)
      goals_.push_back(clearance.centre(free[random() % free.size()]));
  }

  void start() override {
    on_push<BodyStatus>(robot_, [this](auto& x) { status_ = *x; });
    on_change(changed<Movement>().in(navigation_), [this](const ChangeEvent& event) {
      try {
        const auto x = read<Movement>(event.address);
        if (x->plans > 0 && x->plans != plans_)
          planning_times_.push_back(x->planning_time);
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
    info("{} goals: {} reached, {} not; {:.1f} m driven, {:.3f} of the shortest (median; p95 "
         "{:.3f}); stood {:.1f} s; {} recoveries; {} collisions; a plan took {:.1f} ms (p50), "
         "{:.1f} ms (p95) of {}",
         goals_.size(), reached_, goals_.size() - reached_, status_->driven, quantile(ratios_, 0.5),
         quantile(ratios_, 0.95), waited_, recoveries_, status_->collisions,
         1000 * quantile(planning_times_, 0.5), 1000 * quantile(planning_times_, 0.95),
         planning_times_.size());
    if (after_ == AfterGoals::end)
      end_system(0, "all goals were asked for");
  }

  void ask(std::size_t number) {
    const auto& goal = goals_[number];
    const auto begin = *status_;
    const auto shortest = shortest_to(goal);
    // Each action counts its plans anew.
    plans_ = 0;
    GoToPlace what;
    what.x = goal.x;
    what.y = goal.y;
    const auto over = perform(navigation_.get(), what).wait();
    sleep_for(200ms);
    const double driven = status_->driven - begin.driven;
    waited_ += movement_.waited;
    recoveries_ += movement_.recoveries;
    const double away = distance(Point2{status_->pose.x, status_->pose.y}, goal);
    if (over.outcome == ActionOutcome::succeeded) {
      ++reached_;
      if (shortest && *shortest > 1)
        ratios_.push_back(driven / *shortest);
      info("goal {} at {:.2f} {:.2f}: reached, {:.2f} m from it, {:.1f} m driven in {:.1f} s",
           number + 1, goal.x, goal.y, away, driven,
           static_cast<double>(status_->time - begin.time) / 1e6);
    } else {
      const bool is_honest = !map_ || !shortest;
      info("goal {} at {:.2f} {:.2f}: {}{}", number + 1, goal.x, goal.y, over.reason,
           is_honest ? "" : "; yet the map has a way");
    }
  }

  /// Length of the shortest way with the robot's clearance, if there is one on the map.
  std::optional<double> shortest_to(const Point2& goal) const {
    if (!map_)
      return std::nullopt;
    PlanOptions options;
    options.narrowness = 0;
    const auto plan = plan_path(*map_, ClearanceMap(*map_, options.cells),
                                {status_->pose.x, status_->pose.y}, goal, options);
    return plan.points.empty() ? std::nullopt : std::optional{plan.length};
  }

  Option<std::string> goals_text_{this, "goals", "",
                                  "X Y, X Y, ..., metres; empty: drawn of --map"};
  Option<std::string> map_file_{
    this, "map", "", "a .yaml of map_server, for drawing goals and for the shortest ways"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<int> count_{this, "count", 50, "how many goals are drawn"};
  Option<std::int64_t> seed_{this, "seed", 1, "of the goals that are drawn"};
  Option<SubarchitectureName> navigation_{this, "navigation", "navigation",
                                          "subarchitecture of the Navigator"};
  Option<StandaloneName> robot_{this, "robot", "robot", "whose true path and collisions count"};
  Option<AfterGoals> after_{this, "after", AfterGoals::end,
                            "what it does then: stay, or end the system"};

  Path goals_;
  std::optional<CellMap> map_;
  std::optional<BodyStatus> status_;
  Movement movement_;
  std::int64_t plans_ = 0;
  std::size_t reached_ = 0;
  double waited_ = 0;
  std::int64_t recoveries_ = 0;
  std::vector<double> ratios_;
  std::vector<double> planning_times_;
};

CASTOR_COMPONENT(GoalSender, "asks a Navigator for goals, and says how it went")

} // namespace

} // namespace castor::mapping
