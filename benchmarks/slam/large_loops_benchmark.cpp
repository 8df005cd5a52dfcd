// What becomes of large loops: a robot drives once and a half around a corridor, drifts on the way,
// comes back to where it was, and sees it again.
//
//     large_loops_benchmark [OPTION=NUMBER...]
//
// seeds=N (10) and first=N (1) of the building and of noise; width=, height= (40, 26 m) of the
// corridor's outer wall; spacing=M (4) of its doors; repeating=1: all rooms look alike; range=M (8)
// of the laser; slip=FACTOR (1) multiplies how the wheels slip and how their diameters differ.
// Settings of SLAM are changed by their names as in slam_benchmark.
//
// For each run the drift, how far the front end alone is off after a round; how far the corrected
// path is off there, which says whether the loop was closed rightly; and how far it is off in all
// (root mean square and most, aligned with the truth).

#include "castor/benchmarks/slam/relations.hpp"
#include "castor/benchmarks/slam/ring_building.hpp"
#include "castor/benchmarks/slam/slam_settings.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/slam.hpp"

#include <fmt/core.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace castor;

struct Task {
  int seeds = 10;
  int first = 1;
  double range = 8;
  double slip = 1;
  slam_benchmark::RingOptions ring;
  mapping::SlamOptions slam;
};

bool set_option(Task& task, const std::string& name, double value) {
  if (name == "seeds")
    task.seeds = static_cast<int>(value);
  else if (name == "first")
    task.first = static_cast<int>(value);
  else if (name == "width")
    task.ring.width = value;
  else if (name == "height")
    task.ring.height = value;
  else if (name == "spacing")
    task.ring.door_spacing = value;
  else if (name == "repeating")
    task.ring.is_repeating = value != 0;
  else if (name == "range")
    task.range = value;
  else if (name == "slip")
    task.slip = value;
  else if (auto* setting = slam_benchmark::setting(task.slam, name))
    *setting = value;
  else
    return false;
  return true;
}

struct Drive {
  std::vector<mapping::LaserScan> scans;
  std::vector<mapping::Pose2> odometry;
  std::vector<slam_benchmark::TimedPose> truth;
};

constexpr double rounds = 1.5;

Drive drive_around(const Task& task) {
  mapping::BodyOptions options;
  options.seed = task.ring.seed;
  options.laser.max_range = task.range;
  options.drive.slip *= task.slip;
  options.drive.diameter_error *= task.slip;
  mapping::SimulatedBody body(
    mapping::surroundings_in(slam_benchmark::ring_building(task.ring), options), options);
  mapping::PathFollower follower(slam_benchmark::path_around(task.ring, rounds), {});
  constexpr int steps_each_scan = 10;
  Drive result;
  while (!follower.has_arrived()) {
    result.scans.push_back(body.scan());
    result.odometry.push_back(body.odometry().pose);
    result.truth.push_back({result.scans.back().time, body.status().pose});
    if (body.status().collisions > 0)
      throw std::runtime_error(
        fmt::format("seed {}: the robot ran into something", task.ring.seed));
    body.command(follower.velocity_at(body.status().pose));
    for (int k = 0; k < steps_each_scan; ++k)
      body.step();
  }
  return result;
}

struct Outcome {
  std::vector<slam_benchmark::TimedPose> path;
  std::size_t loops = 0;
};

Outcome map_of(const Drive& drive, mapping::SlamOptions options, bool closes_loops) {
  options.closes_loops = closes_loops;
  mapping::Slam slam{options};
  for (std::size_t i = 0; i < drive.scans.size(); ++i)
    slam.add(drive.scans[i], drive.odometry[i]);
  slam.finish();
  Outcome result;
  for (const auto& x : slam.path())
    result.path.push_back({x.time, x.pose});
  result.loops = slam.graph().loops();
  return result;
}

// How far the path says that the robot moved otherwise than it did, from the first pose until it
// was around once.
double drift_of(const std::vector<slam_benchmark::TimedPose>& path, const Drive& drive) {
  const auto i = static_cast<std::size_t>(static_cast<double>(path.size()) / rounds);
  return mapping::distance(mapping::between(path.front().pose, path[i].pose),
                           mapping::between(drive.truth.front().pose, drive.truth[i].pose));
}

void run(const Task& task) {
  // By drift in whole metres, 5 and more together: closed rightly, left open, closed wrongly.
  std::array<std::array<int, 3>, 6> counts{};
  fmt::print("seed  drift m  loops  after m   rms m  most m  outcome\n");
  for (int i = 0; i < task.seeds; ++i) {
    Task one = task;
    one.ring.seed = static_cast<std::uint64_t>(task.first + i);
    const auto drive = drive_around(one);
    const auto open = map_of(drive, task.slam, false);
    const double drift = drift_of(open.path, drive);
    const auto closed = map_of(drive, task.slam, true);
    const auto errors = slam_benchmark::trajectory_errors(closed.path, drive.truth);
    const double after = drift_of(closed.path, drive);
    // Rooms that look alike are further from each other.
    constexpr double right = 0.5;
    constexpr std::array names{"right", "left open", "wrong"};
    const bool is_open = closed.loops == 0;
    const std::size_t outcome = after < right ? 0 : is_open ? 1 : 2;
    ++counts[std::min<std::size_t>(static_cast<std::size_t>(drift), counts.size() - 1)][outcome];
    fmt::print("{:4}  {:7.2f}  {:5}  {:7.3f}  {:6.3f}  {:6.3f}  {}\n", one.ring.seed, drift,
               closed.loops, after, errors.root_mean_square, errors.most, names[outcome]);
  }
  fmt::print("drift        right  left open  wrong\n");
  for (std::size_t i = 0; i < counts.size(); ++i)
    fmt::print("{} m {:8}  {:5}  {:9}  {:5}\n", i, i + 1 < counts.size() ? "to next" : "or more",
               counts[i][0], counts[i][1], counts[i][2]);
}

} // namespace

int main(int argc, char** argv) {
  Task task;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto equals = argument.find('=');
    if (equals == std::string::npos ||
        !set_option(task, argument.substr(0, equals),
                    std::atof(argument.substr(equals + 1).c_str()))) {
      fmt::print(stderr, "large_loops_benchmark [OPTION=NUMBER...]; there is no option {}\n",
                 argument);
      return 2;
    }
  }
  try {
    run(task);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
