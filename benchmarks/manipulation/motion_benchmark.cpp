// Motions of the Katana between random reachable poses on both sides of a wall that is 0.30 m high.
//
//   motion_benchmark [ALGORITHM] [pairs=100] [seed=1] [time=5]
//
// ALGORITHM is rrt_connect, rrt_star or bit_star; the last two use all of their time, in seconds.
// Poses are those of random configurations without contact whose tool is before the arm and lower
// than the wall. From the motion's end only the pose is known; InverseKinematics finds the
// configurations. Motions are checked at steps of a tenth of those that the planner checks, without
// its margin.

#include "castor/base/text_file.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/inverse_kinematics.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/motion_planner.hpp"
#include "castor/planning/manipulation/trajectory.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <string>

namespace {

using namespace castor;
using namespace castor::manipulation;

constexpr double wall_height = 0.3;

Scene wall_on_table() {
  return {{table_top(2, 2),
           {"the wall", box(0.6, 0.05, wall_height), {{0.4, 0, wall_height / 2}, {}, arm_frame}}},
          {}};
}

/// A configuration with the tool on that side of the wall: 1 is the left one.
Configuration beside_wall(const ArmModel& arm, CollisionChecker& checker, double side,
                          std::mt19937& random) {
  while (true) {
    Configuration result;
    for (auto index : moving_joints(arm))
      result.push_back(
        std::uniform_real_distribution(arm.joints[index].lower, arm.joints[index].upper)(random));
    const auto at = tool_pose(arm, result).position;
    if (at.x > 0.1 && at.y * side > 0.05 && at.z > 0.03 && at.z < wall_height &&
        checker.is_free(result))
      return result;
  }
}

struct Pair {
  Configuration start;
  /// All configurations at the pose where the motion ends.
  std::vector<Configuration> goals;
};

/// A pair on both sides of the wall that needs a planner.
Pair random_pair(const ArmModel& arm, const InverseKinematics& inverse, CollisionChecker& checker,
                 double side, std::mt19937& random) {
  while (true) {
    Pair result;
    result.start = beside_wall(arm, checker, side, random);
    const auto goal = tool_pose(arm, beside_wall(arm, checker, -side, random));
    result.goals = inverse.solve(goal, result.start);
    if (std::ranges::none_of(
          result.goals, [&](const auto& x) { return checker.is_free_between(result.start, x); }))
      return result;
  }
}

/// Sorted numbers of all motions.
class Figures {
public:
  void add(double value) { values_.push_back(value); }

  double at(double share) {
    if (values_.empty())
      return 0;
    std::ranges::sort(values_);
    return values_[static_cast<std::size_t>(share * static_cast<double>(values_.size() - 1))];
  }

  void print(const std::string& name, double unit, const std::string& unit_name) {
    fmt::print("  {}: {:.2f} {} (median), {:.2f} (95 %), {:.2f} (largest)\n", name, unit * at(0.5),
               unit_name, unit * at(0.95), unit * at(1));
  }

private:
  std::vector<double> values_;
};

/// How many configurations on the way touch something.
std::size_t contacts_on(const ArmModel& arm, const Scene& scene, const Trajectory& trajectory,
                        double step) {
  CollisionOptions exact;
  exact.margin = 0;
  CollisionChecker checker(arm, scene, exact);
  const int steps = static_cast<int>(std::ceil(trajectory.path().length() / step));
  std::size_t result = 0;
  for (int i = 0; i <= steps; ++i)
    result += !checker.is_free(trajectory.path().at(i * trajectory.path().length() / steps));
  return result;
}

double seconds(std::clock_t begin, std::clock_t end) {
  return static_cast<double>(end - begin) / CLOCKS_PER_SEC;
}

struct Setting {
  MotionPlannerOptions planning;
  int pairs = 100;
  unsigned seed = 1;
};

void run(const ArmModel& arm, const Setting& setting) {
  const auto scene = wall_on_table();
  CollisionChecker checker(arm, scene);
  const InverseKinematics inverse(arm);
  std::mt19937 random(setting.seed);
  Figures planning, total, found_length, length, timing, duration, checks;
  int solved = 0;
  std::size_t contacts = 0;
  auto options = setting.planning;
  for (int i = 0; i < setting.pairs; ++i) {
    const double side = i % 2 ? 1 : -1;
    const auto [start, goals] = random_pair(arm, inverse, checker, side, random);
    options.seed = setting.seed * 1000 + static_cast<unsigned>(i) + 1;
    // The same samples, without time for simplification.
    options.simplification_time_limit = 0;
    const auto begin = std::clock();
    plan_motion(arm, scene, start, goals, "the other side", options);
    const auto found = std::clock();
    options.simplification_time_limit = setting.planning.simplification_time_limit;
    const auto result = plan_motion(arm, scene, start, goals, "the other side", options);
    const auto planned = std::clock();
    if (const auto* failure = std::get_if<MotionFailure>(&result)) {
      fmt::print("pair {}: {}\n", i, failure->text);
      continue;
    }
    const auto& path = std::get<JointPath>(result);
    const auto trajectory = time_parameterise(arm, checker, path.waypoints);
    const auto timed = std::clock();
    ++solved;
    planning.add(seconds(begin, found));
    total.add(seconds(found, planned));
    found_length.add(path.found_length);
    length.add(path.length);
    checks.add(static_cast<double>(path.checks));
    timing.add(seconds(planned, timed));
    duration.add(trajectory.duration());
    contacts += contacts_on(arm, scene, trajectory, checker.step() / 10);
  }
  fmt::print("{} of {} pairs solved; configurations in contact on all ways: {}\n", solved,
             setting.pairs, contacts);
  fmt::print("  time of the processor:\n");
  planning.print("planning", 1e3, "ms");
  total.print("planning and simplification", 1e3, "ms");
  timing.print("rounding of corners and speeds", 1e3, "ms");
  fmt::print("  motions:\n");
  checks.print("collision checks", 1e-3, "thousand");
  found_length.print("length as found", 1, "rad");
  length.print("length after simplification", 1, "rad");
  duration.print("duration of the motion", 1, "s");
}

} // namespace

int main(int argc, char** argv) {
  Setting setting;
  setting.planning.time_limit = 5;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string argument = argv[i];
      if (argument.starts_with("pairs="))
        setting.pairs = std::stoi(argument.substr(6));
      else if (argument.starts_with("seed="))
        setting.seed = static_cast<unsigned>(std::stoul(argument.substr(5)));
      else if (argument.starts_with("time="))
        setting.planning.time_limit = std::stod(argument.substr(5));
      else
        setting.planning.algorithm = planning_algorithm(argument);
    }
    run(load_arm(CASTOR_KATANA).arm, setting);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
