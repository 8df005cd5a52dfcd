#include "castor/benchmarks/manipulation/table_tasks.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"
#include "castor/planning/body/table_things.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <variant>

namespace castor::manipulation {

namespace {

/// What the table's things may be put on, metres.
constexpr double half_width = 0.30;
constexpr double half_depth = 0.26;
/// Where who looks at the table is.
constexpr Spot viewer{0, -0.34};
/// Half a right angle to each side.
constexpr double most_off = std::numbers::pi / 4;
constexpr double near_gap = 0.10;
/// Of what counts as done, radians and metres.
constexpr double angle_tolerance = 5 * std::numbers::pi / 180;
constexpr double gap_tolerance = 0.01;
/// Of things from the arm: it takes low ones there.
constexpr double farthest = 0.38;
/// What has changed places is so near to where the other was.
constexpr double same_place = 0.05;

double distance(const Spot& a, const Spot& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

std::string noun(const RandomThing& x) {
  return "the " + x.colour + ' ' + (x.shape == "sphere" ? "ball" : x.shape);
}

/// The one that the simulated table calls so.
std::map<std::string, const RandomThing*> by_name(const TableTask& task) {
  std::map<std::string, const RandomThing*> result;
  for (const auto& x : task.things) {
    auto name = x.name();
    for (int i = 2; result.contains(name); ++i)
      name = x.name() + ' ' + std::to_string(i);
    result[name] = &x;
  }
  return result;
}

bool is_at(const std::string& relation, const RandomThing& thing, const Spot& at,
           const RandomThing& landmark, const Spot& other, bool is_strict) {
  if (relation == "near")
    return distance(at, other) - (thing.size + landmark.size) / 2 <=
           near_gap + (is_strict ? 0 : gap_tolerance);
  const Spot front{viewer.x - other.x, viewer.y - other.y};
  const std::map<std::string, Spot> axes{{"front", front},
                                         {"back", {-front.x, -front.y}},
                                         {"left", {front.y, -front.x}},
                                         {"right", {-front.y, front.x}}};
  const auto& axis = axes.at(relation);
  const Spot way{at.x - other.x, at.y - other.y};
  const double along = way.x * axis.x + way.y * axis.y;
  return std::acos(along / std::hypot(way.x, way.y) / std::hypot(axis.x, axis.y)) <=
         most_off + (is_strict ? 0 : angle_tolerance);
}

/// How far beyond the table's middle, on that side.
double on_side(const std::string& side, const Spot& at) {
  return side == "left" ? -at.x : side == "right" ? at.x : side == "front" ? -at.y : at.y;
}

bool is_wholly_on(const std::string& side, const RandomThing& x, const Spot& at) {
  return on_side(side, at) > x.size / 2 + gap_tolerance;
}

/// Colours from the left, by the middles of their things.
std::vector<std::string> colours_from_left(const std::vector<RandomThing>& things) {
  std::map<std::string, std::pair<double, int>> sums;
  for (const auto& x : things) {
    sums[x.colour].first += x.x;
    ++sums[x.colour].second;
  }
  std::vector<std::pair<double, std::string>> means;
  for (const auto& [colour, sum] : sums)
    means.emplace_back(sum.first / sum.second, colour);
  std::ranges::sort(means);
  std::vector<std::string> result;
  for (auto& [x, colour] : means)
    result.push_back(std::move(colour));
  return result;
}

bool is_sorted_already(const std::vector<RandomThing>& things) {
  const auto colours = colours_from_left(things);
  const double width = 2 * half_width / static_cast<double>(colours.size());
  return std::ranges::all_of(things, [&](const auto& x) {
    const auto strip = std::ranges::find(colours, x.colour) - colours.begin();
    return std::floor((x.x + half_width) / width) == static_cast<double>(strip);
  });
}

bool has_something_to_do(const TableTask& task) {
  const auto& a = task.things[0];
  const auto& b = task.things[1];
  switch (task.kind) {
    case TaskKind::put:
      return !is_at(task.relation, a, {a.x, a.y}, b, {b.x, b.y}, false);
    case TaskKind::sort:
      return colours_from_left(task.things).size() > 1 && !is_sorted_already(task.things);
    case TaskKind::clear:
      return std::ranges::any_of(task.things, [&](const auto& x) {
        return is_wholly_on(task.relation, x, {x.x, x.y});
      });
    default:
      return true;
  }
}

std::string sentence_of(const TableTask& task) {
  static const std::map<std::string, std::string> words{{"left", "to the left of"},
                                                        {"right", "to the right of"},
                                                        {"front", "in front of"},
                                                        {"back", "behind"},
                                                        {"near", "next to"}};
  const auto first = noun(task.things[0]);
  const auto second = noun(task.things[1]);
  switch (task.kind) {
    case TaskKind::put:
      return "Put " + first + ' ' + words.at(task.relation) + ' ' + second + '.';
    case TaskKind::take:
      return "Take " + first + '.';
    case TaskKind::sort:
      return "Sort the things by colour.";
    case TaskKind::clear:
      return "Clear the " + task.relation + " side of the table.";
    case TaskKind::swap:
      return "Swap " + first + " and " + second + '.';
  }
  return {};
}

/// Makes plans by the true places, one thing after the other.
class TrueTable {
public:
  TrueTable(const TableTask& task, const std::string& arm_file)
    : at_(arm_placement(benchmark_arm_at)), arm_(load_arm(arm_file).arm),
      rest_(arm_posture(arm_, benchmark_arm_rest)), things_(by_name(task)),
      planner_(arm_, options()) {
    const auto parsed = vision::parse_tabletop_scene(scene_text(task.things), "scene");
    scene_ = TableThings(parsed.scene.at(vision::SceneTime{0}), at_).world().scene();
  }

  Spot spot(const std::string& name) const {
    const auto found = std::ranges::find(scene_.things, name, &NamedSolid::name);
    const auto at = geometry::transform(at_, found->pose.position);
    return {at.x, at.y};
  }

  const std::map<std::string, const RandomThing*>& things() const { return things_; }

  bool take(const std::string& name) { return keep(planner_.pick(scene_, name, rest_)); }

  bool move(const std::string& name, const Spot& to) {
    PlaceGoal goal;
    goal.bottom = geometry::transform(geometry::inverse(at_, arm_frame), Point3{to.x, to.y, 0});
    goal.radius = 0.01;
    goal.support = "the table";
    const auto result = planner_.pick_and_place(scene_, name, goal, rest_);
    if (!keep(result))
      return false;
    std::ranges::find(scene_.things, name, &NamedSolid::name)->pose =
      *std::get<ManipulationPlan>(result).goal;
    return true;
  }

  /// To one of the free places that will do, the nearest first.
  bool move(const std::string& name, const std::function<bool(const Spot&)>& will_do) {
    const auto from = spot(name);
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
    for (const auto& x : free) {
      if (std::ranges::any_of(tried, [&](const Spot& y) { return distance(x, y) < 0.05; }))
        continue;
      if (move(name, x))
        return true;
      tried.push_back(x);
      if (tried.size() == most_places)
        break;
    }
    return false;
  }

  const std::string& failure() const { return failure_; }

private:
  static constexpr std::size_t most_places = 20;

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
    if (const auto* failure = std::get_if<MotionFailure>(&result))
      failure_ = failure->text;
    return std::holds_alternative<ManipulationPlan>(result);
  }

  Pose at_;
  ArmModel arm_;
  Configuration rest_;
  std::map<std::string, const RandomThing*> things_;
  ManipulationPlanner planner_;
  Scene scene_;
  std::string failure_;
};

/// Things that are to be moved, and the places that will do for them.
using Moves = std::vector<std::pair<std::string, std::function<bool(const Spot&)>>>;

/// Each as soon as it is possible.
bool can_do_all(TrueTable& table, Moves moves) {
  while (!moves.empty()) {
    const auto done =
      std::ranges::find_if(moves, [&](const auto& x) { return table.move(x.first, x.second); });
    if (done == moves.end())
      return false;
    moves.erase(done);
  }
  return true;
}

bool can_swap(TrueTable& table, const std::string& a, const std::string& b) {
  const auto first = table.spot(a);
  const auto second = table.spot(b);
  const auto between = [&](const Spot& x) {
    return distance(x, first) > 0.1 && distance(x, second) > 0.1;
  };
  return table.move(a, between) && table.move(b, first) && table.move(a, second);
}

} // namespace

TableTask random_table_task(std::uint64_t seed) {
  // Tables on which there is nothing to do are thrown away.
  for (std::uint64_t round = 0;; ++round) {
    std::mt19937_64 random(seed + round * 1'000'003);
    TableTask result;
    result.kind = static_cast<TaskKind>((seed + 4) % 5);
    auto colours = random_colours(random);
    const auto spots = random_spots(random, 3 + random() % 3, farthest);
    if (result.kind == TaskKind::sort)
      colours.resize(2 + random() % 2);
    for (std::size_t i = 0; i < spots.size(); ++i)
      result.things.push_back(random_thing(random, colours[i % colours.size()], spots[i]));
    // The arm does not reach the back of the table with all things.
    constexpr const char* relations[] = {"left", "right", "front", "back", "near"};
    result.relation = relations[random() % (result.kind == TaskKind::put ? 5 : 2)];
    result.sentence = sentence_of(result);
    if (has_something_to_do(result))
      return result;
  }
}

std::string what_is_wrong(const TableTask& task, const std::vector<TrueThing>& things) {
  const auto names = by_name(task);
  std::map<const RandomThing*, const TrueThing*> now;
  for (const auto& x : things)
    now[names.at(x.name)] = &x;
  const auto spot = [&](std::size_t i) {
    const auto& at = now.at(&task.things[i])->pose.position;
    return Spot{at.x, at.y};
  };
  for (std::size_t i = 0; i < task.things.size(); ++i) {
    const auto& support = now.at(&task.things[i])->support;
    const bool is_to_be_held = i == 0 && task.kind == TaskKind::take;
    if (support != (is_to_be_held ? "the gripper" : "the table"))
      return task.things[i].name() + " is on " + support;
  }
  const auto& a = task.things[0];
  const auto& b = task.things[1];
  switch (task.kind) {
    case TaskKind::put:
      if (!is_at(task.relation, a, spot(0), b, spot(1), false))
        return fmt::format("{} is not there, but at {:.3f} {:.3f}", a.name(), spot(0).x, spot(0).y);
      break;
    case TaskKind::take:
      break;
    case TaskKind::sort:
      for (std::size_t i = 0; i < task.things.size(); ++i)
        for (std::size_t j = 0; j < task.things.size(); ++j)
          for (std::size_t k = 0; k < task.things.size(); ++k)
            if (task.things[i].colour == task.things[k].colour &&
                task.things[i].colour != task.things[j].colour && spot(i).x < spot(j).x &&
                spot(j).x < spot(k).x)
              return task.things[j].name() + " is among others";
      break;
    case TaskKind::clear:
      for (std::size_t i = 0; i < task.things.size(); ++i) {
        const auto& x = task.things[i];
        if (is_wholly_on(task.relation, x, spot(i)) ||
            (is_wholly_on(task.relation, x, {x.x, x.y}) && on_side(task.relation, spot(i)) > 0))
          return fmt::format("{} is still there, at {:.3f} {:.3f}", x.name(), spot(i).x, spot(i).y);
      }
      break;
    case TaskKind::swap:
      if (distance(spot(0), {b.x, b.y}) > same_place || distance(spot(1), {a.x, a.y}) > same_place)
        return "they have not changed places";
      break;
  }
  return {};
}

std::string why_unsolvable(const TableTask& task, const std::string& arm_file) {
  TrueTable table(task, arm_file);
  const auto& a = task.things[0];
  const auto& b = task.things[1];
  bool is_solvable = false;
  Moves moves;
  switch (task.kind) {
    case TaskKind::put:
      is_solvable = table.move(a.name(), [&](const Spot& x) {
        return is_at(task.relation, a, x, b, {b.x, b.y}, true);
      });
      break;
    case TaskKind::take:
      is_solvable = table.take(a.name());
      break;
    case TaskKind::swap:
      is_solvable = can_swap(table, a.name(), b.name());
      break;
    case TaskKind::clear: {
      for (const auto& [name, x] : table.things())
        if (is_wholly_on(task.relation, *x, {x->x, x->y}))
          moves.emplace_back(name, [&task, x = x](const Spot& to) {
            return on_side(task.relation, to) < -x->size / 2;
          });
      is_solvable = can_do_all(table, moves);
      break;
    }
    case TaskKind::sort: {
      const auto colours = colours_from_left(task.things);
      const double width = 2 * half_width / static_cast<double>(colours.size());
      for (const auto& [name, x] : table.things()) {
        const auto strip = std::ranges::find(colours, x->colour) - colours.begin();
        const auto is_in = [width, strip](const Spot& at) {
          return std::floor((at.x + half_width) / width) == static_cast<double>(strip);
        };
        if (!is_in({x->x, x->y}))
          moves.emplace_back(name, is_in);
      }
      is_solvable = can_do_all(table, moves);
      break;
    }
  }
  return is_solvable ? std::string{} : table.failure();
}

} // namespace castor::manipulation
