#include "castor/benchmarks/manipulation/place_goal.hpp"
#include "castor/benchmarks/manipulation/table_relations.hpp"
#include "castor/benchmarks/manipulation/table_tasks.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"
#include "castor/planning/body/table_things.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/seen_table.hpp"
#include "castor/planning/manipulation/way_between.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <variant>

namespace castor::manipulation {

namespace {

/// Whether a place will do for a thing.
using WillDo = std::function<bool(const Spot&)>;
/// Things that are to be moved, and the places that will do for them.
using Moves = std::vector<std::pair<std::string, WillDo>>;

/// Makes plans by the true places, one thing after the other.
class TrueTable {
public:
  /// @param things of the task, where they are now
  TrueTable(const TableTask& task, const std::vector<RandomThing>& things, const ArmModel& arm,
            const Configuration& rest)
    : at_(arm_placement(benchmark_arm_at)), rest_(rest), things_(by_name(task)),
      planner_(arm, options()) {
    const auto parsed = vision::parse_tabletop_scene(scene_text(things), "scene");
    scene_ = TableThings(parsed.scene.at(vision::SceneTime{0}), at_).world().scene();
  }

  Spot spot(const std::string& name) const {
    const auto found = std::ranges::find(scene_.things, name, &NamedSolid::name);
    const auto at = geometry::transform(at_, found->pose.position);
    return {at.x, at.y};
  }

  const std::map<std::string, const RandomThing*>& things() const { return things_; }

  bool take(const std::string& name) { return keep(planner_.pick(scene_, name, rest_)); }

  /// @param between whether it may be put down somewhere on the way
  bool move(const std::string& name, const Spot& to, bool between) {
    const auto goal = goal_at(to);
    const auto before = scene_;
    auto& thing = *std::ranges::find(scene_.things, name, &NamedSolid::name);
    for (int i = 0; i < (between ? 2 : 0); ++i) {
      StopsBetween stops{planner_, scene_, name,
                         free_places(others(name), thing.solid.size.x, true), rest_};
      if (const auto plan = stops.plan_to(goal))
        thing.pose = *plan->goal;
    }
    const auto result = planner_.pick_and_place(scene_, name, goal, rest_);
    if (keep(result))
      thing.pose = *std::get<ManipulationPlan>(result).goal;
    else
      scene_ = before;
    return std::holds_alternative<ManipulationPlan>(result);
  }

  /// To one of the free places that will do, the nearest first, and such that `then` can be done.
  bool move(
    const std::string& name, const WillDo& will_do,
    const std::function<bool()>& then = [] { return true; }, std::size_t most_tried = most_places) {
    const auto from = spot(name);
    const auto before = scene_;
    std::vector<Spot> free;
    constexpr double step = 0.02;
    const double radius = things_.at(name)->size / 2;
    for (double x = -half_width + radius; x <= half_width - radius; x += step)
      for (double y = -half_depth + radius; y <= half_depth - radius; y += step)
        if (will_do({x, y}) && is_free(name, {x, y}))
          free.push_back({x, y});
    if (free.empty())
      failure_ = "there is no free place";
    std::ranges::sort(free, {}, [&](const Spot& x) { return distance(x, from); });
    std::vector<Spot> tried;
    for (const auto& x : free)
      if (tried.size() < most_tried &&
          std::ranges::none_of(tried, [&](const Spot& y) { return distance(x, y) < 0.05; }))
        tried.push_back(x);
    for (const bool between : {false, true}) {
      for (const auto& x : tried) {
        if (move(name, x, between) && then())
          return true;
        scene_ = before;
      }
      tried.resize(std::min(tried.size(), most_places_between));
    }
    return false;
  }

  /// If need be, after one of the others that is in its way.
  bool move_after(const std::string& name, const WillDo& will_do, const Moves& others) {
    in_way_.clear();
    if (move(name, will_do))
      return true;
    const auto why = failure_;
    const auto in_way = in_way_;
    const auto goes_first = [&](const auto& x) {
      return x.first != name && in_way.contains(x.first) &&
             move(
               x.first, x.second, [&] { return move(name, will_do); }, most_places_between);
    };
    const bool is_possible = std::ranges::any_of(others, goes_first);
    failure_ = why;
    return is_possible;
  }

  const std::string& failure() const { return failure_; }

private:
  static constexpr std::size_t most_places = 20;
  static constexpr std::size_t most_places_between = 4;

  std::vector<SeenThing> others(const std::string& name) const {
    std::vector<SeenThing> result;
    for (const auto& x : scene_.things)
      if (x.name != name && things_.contains(x.name))
        result.push_back({{}, {}, {}, x});
    return result;
  }

  static ManipulationOptions options() {
    ManipulationOptions result;
    result.grasps.spare = 0.024;
    result.motions.time_limit = 1;
    return result;
  }

  bool is_free(const std::string& name, const Spot& at) const {
    constexpr double gap = 0.02;
    return std::ranges::all_of(things_, [&](const auto& x) {
      return x.first == name ||
             distance(spot(x.first), at) > (x.second->size + things_.at(name)->size) / 2 + gap;
    });
  }

  bool keep(const ManipulationResult& result) {
    if (const auto* failure = std::get_if<MotionFailure>(&result)) {
      failure_ = failure->text;
      in_way_.insert(failure->obstacles.begin(), failure->obstacles.end());
    }
    return std::holds_alternative<ManipulationPlan>(result);
  }

  Pose at_;
  Configuration rest_;
  std::map<std::string, const RandomThing*> things_;
  ManipulationPlanner planner_;
  Scene scene_;
  std::string failure_;
  /// Names of what was in the way.
  std::set<std::string> in_way_;
};

/// Each as soon as it is possible.
/// @param movable may be moved before one of them
bool can_do_all(TrueTable& table, Moves moves, const Moves& movable) {
  while (!moves.empty()) {
    auto done =
      std::ranges::find_if(moves, [&](const auto& x) { return table.move(x.first, x.second); });
    if (done == moves.end())
      done = std::ranges::find_if(
        moves, [&](const auto& x) { return table.move_after(x.first, x.second, movable); });
    if (done == moves.end())
      return false;
    moves.erase(done);
  }
  return true;
}

/// @param first,second where they were
bool can_swap(TrueTable& table, const std::string& a, const Spot& first, const std::string& b,
              const Spot& second) {
  const auto between = [&](const Spot& x) {
    return distance(x, first) > 0.1 && distance(x, second) > 0.1;
  };
  const auto bring = [&](const std::string& x, const Spot& to) {
    return distance(table.spot(x), to) < gap_tolerance || table.move(x, to, false) ||
           table.move(x, to, true);
  };
  const auto in_this_order = [&](const std::string& x, const Spot& to_x, const std::string& y,
                                 const Spot& to_y) {
    return (bring(y, to_y) && bring(x, to_x)) ||
           table.move(x, between, [&] { return bring(y, to_y) && bring(x, to_x); });
  };
  return in_this_order(a, second, b, first) || in_this_order(b, first, a, second);
}

/// Things of the task where they are now.
std::vector<RandomThing> things_now(const TableTask& task, const std::vector<TrueThing>& now) {
  auto result = task.things;
  for (const auto& [name, thing] : by_name(task)) {
    const auto& pose = std::ranges::find(now, name, &TrueThing::name)->pose;
    auto& x = result[static_cast<std::size_t>(thing - task.things.data())];
    const auto ahead = geometry::rotate(pose.rotation, Point3{1, 0, 0});
    x.x = pose.position.x;
    x.y = pose.position.y;
    x.turned = std::atan2(ahead.y, ahead.x) * 180 / std::numbers::pi;
  }
  return result;
}

std::string why_unsolvable_from(const TableTask& task, const std::vector<RandomThing>& things,
                                const ArmModel& arm, const Configuration& rest) {
  TrueTable table(task, things, arm, rest);
  const auto& a = task.things[0];
  const auto& b = task.things[1];
  bool is_solvable = false;
  Moves moves;
  switch (task.kind) {
    case TaskKind::put:
      is_solvable = table.move_after(
        a.name(),
        [&](const Spot& x) { return is_at(task.relation, a, x, b, table.spot(b.name()), true); },
        {{b.name(), [](const Spot&) { return true; }}});
      break;
    case TaskKind::take:
      is_solvable = table.take(a.name());
      break;
    case TaskKind::swap:
      is_solvable = can_swap(table, a.name(), {a.x, a.y}, b.name(), {b.x, b.y});
      break;
    case TaskKind::clear: {
      for (const auto& [name, x] : table.things())
        if (is_wholly_on(task.relation, *x, {x->x, x->y}) &&
            on_side(task.relation, table.spot(name)) > 0)
          moves.emplace_back(name, [&task, x = x](const Spot& to) {
            return on_side(task.relation, to) < -x->size / 2;
          });
      is_solvable = can_do_all(table, moves, moves);
      break;
    }
    case TaskKind::sort: {
      const auto colours = colours_from_left(task.things);
      const double width = 2 * half_width / static_cast<double>(colours.size());
      Moves all;
      for (const auto& [name, x] : table.things()) {
        const auto strip = std::ranges::find(colours, x->colour) - colours.begin();
        const auto is_in = [width, strip](const Spot& at) {
          return std::floor((at.x + half_width) / width) == static_cast<double>(strip);
        };
        all.emplace_back(name, is_in);
        if (!is_in(table.spot(name)))
          moves.emplace_back(name, is_in);
      }
      is_solvable = can_do_all(table, moves, all);
      break;
    }
  }
  return is_solvable ? std::string{} : table.failure();
}

} // namespace

std::string why_unsolvable(const TableTask& task, const std::string& arm_file,
                           const std::optional<StillJoint>& still,
                           const std::vector<TrueThing>& now) {
  auto arm = load_arm(arm_file).arm;
  const auto rest = arm_posture(arm, benchmark_arm_rest);
  if (still)
    arm = with_still_joint(arm, still->index, still->at);
  auto result = why_unsolvable_from(task, task.things, arm, kept_within_limits(arm, rest));
  const bool all_stand = !now.empty() && std::ranges::all_of(now, [](const auto& x) {
    return x.support == "the table";
  });
  if (!result.empty() && all_stand)
    result = why_unsolvable_from(task, things_now(task, now), arm, kept_within_limits(arm, rest));
  return result;
}

} // namespace castor::manipulation
