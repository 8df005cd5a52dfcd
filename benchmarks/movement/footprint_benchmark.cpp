// How robots move whose footprints are no discs: plans of plan_poses, and PosePursuit with a
// simulated body that knows its pose. Nobody walks.
//
//     footprint_benchmark [WORLD] [VARIABLE=NUMBER...]
//
// WORLD is the file of a building (the office by default) or the .yaml of a map. Variables: first
// (1) and seeds (1), goals (30, of each seed), guard (1: commands pass the rules of the SafetyGuard),
// laser (180: its field of view, degrees). A robot of 1.2 by 0.5 m that turns on the spot and a
// car of 0.7 by 0.44 m that drives circles of 0.5 m go to goals with headings that are drawn of
// poses where they fit. Planned ways are checked with the obstacles of the building itself, not by
// its map.

#include "castor/benchmarks/movement/movement_world.hpp"
#include "castor/mapping/body/seen_obstacles.hpp"
#include "castor/mapping/movement/pose_pursuit.hpp"
#include "castor/mapping/safety/safety_rules.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace castor::benchmark {

using namespace mapping;

namespace {

struct Robot {
  std::string name;
  Footprint footprint;
  double turning_radius = 0;
};

struct Tally {
  int goals = 0;
  int planned = 0;
  int proved = 0;
  int not_found = 0;
  int reached = 0;
  std::int64_t collisions = 0;
  int new_plans = 0;
  double driven = 0;
  double time = 0;
  /// Of planned ways, from what the robot may run into.
  double least_gap = std::numeric_limits<double>::infinity();
  /// Seconds.
  std::vector<double> planning;
  /// How long it was slowed down by the guard, seconds.
  double guarded = 0;
};

struct RunOptions {
  bool guard = true;
  int laser = 180;
};

double quantile(std::vector<double> x, double share) {
  if (x.empty())
    return 0;
  std::ranges::sort(x);
  return x[static_cast<std::size_t>(share * static_cast<double>(x.size() - 1) + 0.5)];
}

PosePursuitOptions options_of(const Robot& robot) {
  PosePursuitOptions result{robot.footprint, {}, {}, {}};
  if (robot.turning_radius > 0) {
    result.plan.steering = PoseSteering::reeds_shepp;
    result.plan.turning_radius = 1.2 * robot.turning_radius;
    result.follow.turning_radius = robot.turning_radius;
  }
  return result;
}

/// Least distance of the footprint from obstacles along a path.
double gap_along(const PosePath& path, const Footprint& footprint, const Obstacles& obstacles) {
  double result = std::numeric_limits<double>::infinity();
  auto begin = path.start;
  for (const auto& x : path.motions) {
    constexpr double step = 0.02; // metres
    const double way = std::abs(x.forward) + footprint.outer_radius() * std::abs(x.turn);
    const int pieces = static_cast<int>(way / step) + 1;
    for (int i = 0; i <= pieces; ++i)
      result = std::min(
        result, footprint.clearance(pose_on(begin, x, static_cast<double>(i) / pieces),
                                    [&](const Point2& p) { return obstacles.clearance(p, 1); }));
    begin = pose_on(begin, x, 1);
  }
  return result;
}

class Run {
public:
  Run(const MovementWorld& world, const Robot& robot, std::uint64_t seed, const RunOptions& how)
    : robot_(robot), how_(how), options_(options_of(robot)), map_(options_.plan.cells),
      random_(seed), body_options_(body_options(robot, seed, how)), checked_(world.surroundings(body_options_)),
      body_(world.surroundings(body_options_), body_options_) {
    map_.update(world.map(), 0);
  }

  void go(int goals, Tally& tally) {
    for (int i = 0; i < goals; ++i)
      go_to(drawn_goal(), tally);
    tally.time += static_cast<double>(body_.time().count()) / 1e6;
    tally.driven += body_.status().driven;
    tally.guarded += guarded_;
  }

private:
  static BodyOptions body_options(const Robot& robot, std::uint64_t seed, const RunOptions& how) {
    BodyOptions result;
    result.laser.field_of_view = how.laser;
    result.seed = seed;
    result.footprint = robot.footprint;
    result.drive.turning_radius = robot.turning_radius;
    return result;
  }

  static SafetyOptions safety_options(const Robot& robot) {
    SafetyOptions result;
    result.footprint = robot.footprint;
    result.turning_radius = robot.turning_radius;
    return result;
  }

  Pose2 drawn_goal() {
    const FootprintRoom room(map_.clearance(), robot_.footprint, options_.plan.margin);
    const auto cells = map_.cells().cells.size();
    while (true) {
      const auto place = map_.clearance().centre(random_() % cells);
      const double heading =
        std::uniform_real_distribution<>(-std::numbers::pi, std::numbers::pi)(random_);
      if (room.at({place.x, place.y, heading}) > 0)
        return {place.x, place.y, heading};
    }
  }

  void go_to(const Pose2& goal, Tally& tally) {
    const auto begin = body_.status();
    ++tally.goals;
    const auto begun = std::chrono::steady_clock::now();
    const auto planned = plan_poses(map_.cells(), map_.clearance(), robot_.footprint, begin.pose,
                                    {goal.x, goal.y}, goal.heading, options_.plan);
    tally.planning.push_back(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
    if (planned.path.empty()) {
      ++(planned.is_proved ? tally.proved : tally.not_found);
      return;
    }
    ++tally.planned;
    tally.least_gap =
      std::min(tally.least_gap, gap_along(planned.path, robot_.footprint, *checked_.obstacles));
    PosePursuit pursuit({goal.x, goal.y}, goal.heading, options_);
    const auto last = pursue(pursuit);
    if (last.status == MovementStatus::arrived)
      ++tally.reached;
    else
      fmt::print("    {}: {:.2f} {:.2f} heading {:.2f}: {}\n", robot_.name, goal.x, goal.y,
                 goal.heading, last.reason);
    tally.collisions += body_.status().collisions - begin.collisions;
    tally.new_plans += pursuit.plans() - 1;
  }

  Pursuit::Step pursue(PosePursuit& pursuit) {
    constexpr std::int64_t longest = 600'000'000;
    const auto begin = body_.time().count();
    Pursuit::Step last;
    while (last.status != MovementStatus::arrived && last.status != MovementStatus::failed) {
      body_.step();
      const auto pose = body_.status().pose;
      if (body_.steps() % 10 == 0)
        seen_.add(body_.scan(), pose);
      guard(last.velocity);
      if (body_.steps() % 5 != 0)
        continue;
      const auto seen = seen_.points();
      last = pursuit.step(body_.time().count(), pose, {map_, seen});
      if (!how_.guard)
        body_.command(last.velocity);
      if (body_.time().count() - begin > longest)
        return {{}, MovementStatus::failed, {}, "it took too long"};
    }
    body_.command({});
    return last;
  }

  /// As often as the SafetyGuard decides.
  void guard(const Twist2& wanted) {
    constexpr int period = 2; // steps
    constexpr double seconds = 0.02;
    if (!how_.guard || body_.steps() % period != 0)
      return;
    const auto now = body_.time().count();
    rules_.add(body_.odometry(), now);
    if (body_.steps() % 10 == 0)
      rules_.add(body_.scan(), now);
    const auto verdict = rules_.verdict(wanted, now);
    guarded_ += verdict.reason == SafetyReason::none ? 0 : seconds;
    body_.command(verdict.velocity);
  }

  const Robot& robot_;
  RunOptions how_;
  PosePursuitOptions options_;
  PlanningMap map_;
  std::mt19937_64 random_;
  BodyOptions body_options_;
  /// What planned ways are checked with.
  BodySurroundings checked_;
  SimulatedBody body_;
  SeenObstacles seen_;
  SafetyRules rules_{safety_options(robot_)};
  double guarded_ = 0;
};

void run(const std::string& world_name, const std::map<std::string, int>& variables) {
  const std::vector<Robot> robots{
    {"long robot", Footprint{{{0.6, 0.25}, {-0.6, 0.25}, {-0.6, -0.25}, {0.6, -0.25}}}, 0},
    {"car", Footprint{{{0.55, 0.22}, {-0.15, 0.22}, {-0.15, -0.22}, {0.55, -0.22}}}, 0.5}};
  for (const auto& robot : robots) {
    Tally x;
    for (int i = 0; i < variables.at("seeds"); ++i) {
      const auto seed = static_cast<std::uint64_t>(variables.at("first") + i);
      const MovementWorld world(world_name, seed);
      Run(world, robot, seed, {variables.at("guard") != 0, variables.at("laser")})
        .go(variables.at("goals"), x);
    }
    fmt::print("{}: {} goals, {} planned, {} cannot be reached, {} not found; gap of plans at "
               "least {:.3f} m; plan p50 {:.1f} ms, p95 {:.1f} ms, most {:.1f} ms; {} reached, {} "
               "collisions, {} new plans on the way, {:.0f} m in {:.0f} s, slowed down by the guard "
               "for {:.0f} s\n",
               robot.name, x.goals, x.planned, x.proved, x.not_found, x.least_gap,
               1000 * quantile(x.planning, 0.5), 1000 * quantile(x.planning, 0.95),
               1000 * quantile(x.planning, 1), x.reached, x.collisions, x.new_plans, x.driven,
               x.time, x.guarded);
    std::fflush(stdout);
  }
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  std::string world = CASTOR_CONFIGS "/buildings/office.building";
  std::map<std::string, int> variables{{"first", 1}, {"seeds", 1}, {"goals", 30}, {"guard", 1}, {"laser", 180}};
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (const auto equals = word.find('='); equals == word.npos)
        world = word;
      else
        variables.at(word.substr(0, equals)) = std::stoi(word.substr(equals + 1));
    }
    castor::benchmark::run(world, variables);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
