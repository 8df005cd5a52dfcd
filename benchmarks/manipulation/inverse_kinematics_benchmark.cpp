// Inverse kinematics: of how many reachable poses solutions are found, how exact they are, and how
// long that takes.
//
//   inverse_kinematics_benchmark [ARM-FILE] [poses=10000] [seed=1]
//
// A pose is reachable because it is that of a random configuration within the limits. Compared are
// the closed form, which the arm file has to permit, and damped least squares, which starts from
// the home configuration.

#include "castor/base/text_file.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/inverse_kinematics.hpp"
#include "castor/planning/manipulation/kinematic_chain.hpp"
#include "castor/planning/manipulation/kinematics.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <random>
#include <string>

namespace {

using namespace castor;
using namespace castor::manipulation;

using Clock = std::chrono::steady_clock;
using Solve = std::function<std::vector<Configuration>(const Pose&)>;

/// How far a configuration brings the tool, or points of it at 1 m, from the pose; metres.
double error_of(const ArmModel& arm, const Configuration& configuration, const Pose& tool) {
  const auto reached = tool_pose(arm, configuration);
  double result = geometry::distance(reached.position, tool.position);
  for (const auto& axis : {Point3{1, 0, 0}, Point3{0, 1, 0}, Point3{0, 0, 1}})
    result = std::max(result, geometry::distance(geometry::rotate(reached.rotation, axis),
                                                 geometry::rotate(tool.rotation, axis)));
  return result;
}

void measure(const std::string& name, const ArmModel& arm, const std::vector<Pose>& poses,
             const Solve& solve) {
  std::size_t solved = 0;
  std::size_t solutions = 0;
  double worst = 0;
  std::vector<double> times;
  for (const auto& tool : poses) {
    const auto begin = Clock::now();
    const auto found = solve(tool);
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    solved += !found.empty();
    solutions += found.size();
    for (const auto& x : found)
      worst = std::max(worst, within_limits(arm, x) ? error_of(arm, x, tool) : 1);
  }
  std::ranges::sort(times);
  fmt::print("{}: {} of {} poses solved, {:.2f} solutions each, largest error {:.1e}; "
             "{:.1f} us (median), {:.1f} us (95 %), {:.1f} us (longest)\n",
             name, solved, poses.size(),
             static_cast<double>(solutions) / static_cast<double>(poses.size()), worst,
             times[times.size() / 2], times[times.size() * 95 / 100], times.back());
}

} // namespace

int main(int argc, char** argv) {
  std::string file = CASTOR_KATANA;
  int poses_wanted = 10000;
  unsigned seed = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.starts_with("poses="))
      poses_wanted = std::stoi(argument.substr(6));
    else if (argument.starts_with("seed="))
      seed = static_cast<unsigned>(std::stoul(argument.substr(5)));
    else
      file = argument;
  }
  try {
    const auto arm = load_arm(file).arm;
    std::mt19937 random(seed);
    std::vector<Pose> poses;
    for (int i = 0; i < poses_wanted; ++i) {
      Configuration configuration;
      for (auto index : moving_joints(arm))
        configuration.push_back(
          std::uniform_real_distribution(arm.joints[index].lower, arm.joints[index].upper)(random));
      poses.push_back(tool_pose(arm, configuration));
    }
    const InverseKinematics inverse(arm);
    if (inverse.is_closed_form())
      measure("closed form", arm, poses, [&](const auto& x) { return inverse.solve(x, arm.home); });
    const KinematicChain chain(arm);
    measure("damped least squares", arm, poses,
            [&](const auto& x) { return solve_damped_least_squares(arm, chain, x, arm.home, 1); });
  } catch (const TextFileError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
