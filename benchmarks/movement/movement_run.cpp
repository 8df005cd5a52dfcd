#include "castor/benchmarks/movement/movement_run.hpp"

#include "castor/benchmarks/movement/crowd.hpp"
#include "castor/mapping/body/seen_obstacles.hpp"
#include "castor/mapping/movement/mover_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <random>
#include <utility>

namespace castor::benchmark {

using namespace mapping;

namespace {

std::vector<Point2> drawn_goals(const PlanningMap& map, const MovementRunOptions& options) {
  const auto& plan = options.pursuit.plan;
  const double least = options.fitting ? plan.radius + plan.margin : 0;
  std::vector<std::size_t> choice;
  for (std::size_t i = 0; i < map.cells().cells.size(); ++i)
    if (map.cells().cells[i] >= 0 && map.cells().cells[i] < plan.cells.occupied_from &&
        map.clearance().at(i) >= least)
      choice.push_back(i);
  std::mt19937_64 random(options.seed);
  std::vector<Point2> result;
  for (int i = 0; i < options.goals; ++i)
    result.push_back(map.clearance().centre(choice[random() % choice.size()]));
  return result;
}

/// A robot with its laser and its map.
class Robot {
public:
  Robot(const MovementWorld& world, const MovementRunOptions& options)
    : options_(options), map_(options.pursuit.plan.cells),
      body_(surroundings(world, options), body_options(options)) {
    map_.update(world.map(), 0);
  }

  MovementRun run() {
    for (const auto& goal : drawn_goals(map_, options_))
      go(goal);
    result_.time = static_cast<double>(body_.time().count()) / 1e6;
    return std::move(result_);
  }

private:
  static BodyOptions body_options(const MovementRunOptions& options) {
    auto result = options.body;
    result.people = options.people > 0;
    result.seed = options.seed;
    return result;
  }

  static BodySurroundings surroundings(const MovementWorld& world,
                                       const MovementRunOptions& options) {
    auto result = world.surroundings(body_options(options));
    result.people =
      crowd(world.map(), {result.start.x, result.start.y}, options.people, options.seed);
    return result;
  }

  void go(const Point2& goal) {
    const auto begin = body_.status();
    const Point2 start{begin.pose.x, begin.pose.y};
    const auto& plan = options_.pursuit.plan;
    GoalOutcome x;
    x.reachability = ReachabilityCheck(map_.cells(), start, plan.radius + plan.margin).of(goal);
    x.shortest = shortest(start, goal);
    GoalPursuit pursuit(goal, std::nullopt, options_.pursuit);
    const auto last = pursue(pursuit, begin.time);
    const auto end = body_.status();
    x.is_reached = last.status == MovementStatus::arrived;
    x.driven = end.driven - begin.driven;
    x.waited = static_cast<double>(pursuit.waited()) / 1e6;
    x.recoveries = pursuit.recoveries();
    x.collisions = end.collisions - begin.collisions;
    result_.tally.add(x);
    if (!x.is_reached && x.reachability == Reachability::reachable)
      result_.remarks.push_back(fmt::format("goal {:.2f} {:.2f}, {:.0f} s: {}", goal.x, goal.y,
                                            seconds(end.time), last.reason));
  }

  static double seconds(std::int64_t time) { return static_cast<double>(time) / 1e6; }

  std::optional<double> shortest(const Point2& start, const Point2& goal) const {
    auto options = options_.pursuit.plan;
    options.narrowness = 0;
    options.explains = false;
    const auto plan = plan_path(map_.cells(), map_.clearance(), start, goal, options);
    return plan.points.empty() ? std::nullopt : std::optional{plan.length};
  }

  GoalPursuit::Step pursue(GoalPursuit& pursuit, std::int64_t begin) {
    GoalPursuit::Step last;
    while (last.status != MovementStatus::arrived && last.status != MovementStatus::failed) {
      body_.step();
      if (body_.steps() % odometry_steps == 0)
        watch_.add(body_.odometry());
      if (body_.steps() % scan_steps == 0)
        look();
      if (body_.steps() % command_steps != 0)
        continue;
      note_collision(last);
      last = step(pursuit);
      body_.command(last.velocity);
      if (seconds(body_.time().count() - begin) > options_.longest) {
        last.status = MovementStatus::failed;
        last.reason = "it took too long: " + last.waits_for;
      }
    }
    return last;
  }

  void look() {
    const auto scan = body_.scan();
    seen_.add(scan, body_.status().pose);
    watch_.add(scan);
    options_.on_scan(scan, body_.odometry(), body_.status());
  }

  GoalPursuit::Step step(GoalPursuit& pursuit) {
    const int plans = pursuit.plans();
    const auto begun = std::chrono::steady_clock::now();
    const auto robot = body_.status().pose;
    const auto seen = seen_.points();
    const auto movers = watch_.movers(robot);
    const auto result = pursuit.step(body_.time().count(), robot, {map_, seen, movers});
    if (pursuit.plans() != plans)
      result_.tally.add_plan(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
    return result;
  }

  void note_collision(const GoalPursuit::Step& last) {
    const auto now = body_.status();
    if (now.collisions == collisions_)
      return;
    collisions_ = now.collisions;
    double nearest = 1e9;
    for (const auto& x : body_.people().discs())
      nearest = std::min(nearest, distance(x.centre, {now.pose.x, now.pose.y}) - x.radius);
    result_.remarks.push_back(
      fmt::format("collision at {:.2f} {:.2f}, {:.1f} s, {} with {:.2f} m/s: {}", now.pose.x,
                  now.pose.y, seconds(now.time), to_text(last.status), last.velocity.forward,
                  nearest < options_.body.radius + 0.03 ? "a person" : "no person"));
  }

  static std::string to_text(MovementStatus x) {
    return x == MovementStatus::recovering ? "recovering" : "moving";
  }

  static constexpr int odometry_steps = 2;
  static constexpr int scan_steps = 10;
  static constexpr int command_steps = 5;

  const MovementRunOptions& options_;
  PlanningMap map_;
  SimulatedBody body_;
  SeenObstacles seen_;
  MoverWatch watch_;
  MovementRun result_;
  std::int64_t collisions_ = 0;
};

} // namespace

MovementRun run_movement(const MovementWorld& world, const MovementRunOptions& options) {
  return Robot(world, options).run();
}

} // namespace castor::benchmark
