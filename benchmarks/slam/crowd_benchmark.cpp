// What becomes of SLAM among people who walk: a simulated robot that knows its pose drives to goals
// among them, and SLAM maps what it sees.
//
//     crowd_benchmark [WORLD] [OPTION=NUMBER...]
//
// WORLD is the file of a building (the office by default) or generated:SEED. seeds=N (3) and
// first=N (1) of people, goals and noise; people=N (10), goals=N (10), legs=1: the laser sees legs
// in place of discs, laser=DEGREES (180). Settings of SLAM are changed by their names as in
// slam_benchmark.
//
// For each run how far from the truth (after rigid alignment of the whole path, median and most)
// are: the front end alone, the path in the end, and the poses as they were known at the time
// (without alignment: the map's frame is that of the first pose). Loops that are off by more than
// 0.3 m. Ghosts: occupied cells of the map further than 0.2 m from all that stands.

#include "castor/benchmarks/movement/movement_run.hpp"
#include "castor/benchmarks/slam/relations.hpp"
#include "castor/benchmarks/slam/slam_settings.hpp"
#include "castor/mapping/grid/keyframe_grid.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/slam.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor::slam_benchmark {

namespace {

struct Task {
  std::string world = CASTOR_CONFIGS "/buildings/office.building";
  std::map<std::string, double> numbers{{"seeds", 3},  {"first", 1}, {"people", 10},
                                        {"goals", 10}, {"legs", 0},  {"laser", 180}};
  mapping::SlamOptions slam;
};

struct Drive {
  std::vector<mapping::LaserScan> scans;
  std::vector<mapping::Pose2> odometry;
  std::vector<TimedPose> truth;
  std::string tally;
};

Drive drive(const benchmark::MovementWorld& world, const Task& task, std::uint64_t seed) {
  benchmark::MovementRunOptions options;
  options.seed = seed;
  options.people = static_cast<int>(task.numbers.at("people"));
  options.goals = static_cast<int>(task.numbers.at("goals"));
  options.body.legs = task.numbers.at("legs") != 0;
  options.body.laser.field_of_view = static_cast<int>(task.numbers.at("laser"));
  Drive result;
  options.on_scan = [&](const auto& scan, const auto& odometry, const auto& status) {
    result.scans.push_back(scan);
    result.odometry.push_back(odometry.pose);
    result.truth.push_back({scan.time, status.pose});
  };
  result.tally = run_movement(world, options).tally.text();
  return result;
}

struct Outcome {
  TrajectoryErrors path;
  /// At the time, in the frame of the first pose.
  double live_median = 0;
  double live_most = 0;
  std::size_t loops = 0;
  std::size_t doubted = 0;
  std::size_t dead_reckoned = 0;
  std::size_t ghosts = 0;
  double time = 0;
};

std::size_t ghosts_in(const std::vector<mapping::Keyframe>& keyframes,
                      const std::vector<mapping::Pose2>& poses, const mapping::Pose2& frame,
                      const mapping::Obstacles& seen) {
  mapping::KeyframeGrid map;
  for (std::size_t i = 0; i < keyframes.size(); ++i)
    map.place(std::to_string(i), std::make_shared<const mapping::LaserScan>(keyframes[i].scan),
              mapping::compose(frame, poses[i]));
  const auto& grid = map.grid();
  std::size_t result = 0;
  for (const auto& tile : grid.tiles()) {
    const auto cells = grid.cells(tile);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      constexpr std::int8_t occupied = 9; // log-odds of 0.4: a probability of 60 %
      if (cells[i] == mapping::unknown_cell || cells[i] < occupied)
        continue;
      const auto side = static_cast<std::size_t>(mapping::tile_side);
      const auto first = mapping::first_cell(tile);
      const auto centre = mapping::centre_of({first.column + static_cast<std::int32_t>(i % side),
                                              first.row + static_cast<std::int32_t>(i / side)},
                                             grid.cell_size());
      result += seen.clearance(centre, 1) > 0.2 ? 1 : 0;
    }
  }
  return result;
}

Outcome map_of(const Drive& drive, mapping::SlamOptions options, bool closes_loops,
               const mapping::Obstacles& seen) {
  options.closes_loops = closes_loops;
  mapping::Slam slam{options};
  Outcome result;
  std::vector<double> live;
  std::vector<mapping::Keyframe> keyframes;
  const auto begun = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    auto step = slam.add(drive.scans[i], drive.odometry[i]);
    if (step.new_keyframe)
      keyframes.push_back(std::move(*step.new_keyframe));
    const auto here = mapping::compose(slam.graph().pose(step.keyframe), step.on_keyframe);
    live.push_back(
      mapping::distance(mapping::between(drive.truth.front().pose, drive.truth[i].pose),
                        mapping::between(slam.graph().pose(0), here)));
  }
  slam.finish();
  result.time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  std::vector<TimedPose> path;
  for (const auto& x : slam.path())
    path.push_back({x.time, x.pose});
  result.path = trajectory_errors(path, drive.truth);
  std::ranges::sort(live);
  result.live_median = live[live.size() / 2];
  result.live_most = live.back();
  result.loops = slam.graph().loops();
  result.doubted = slam.graph().doubted_loops();
  result.dead_reckoned = slam.dead_reckoned();
  const auto first = slam.graph().pose(0);
  const auto frame = mapping::compose(drive.truth.front().pose, mapping::between(first, {}));
  result.ghosts = ghosts_in(keyframes, slam.graph().poses(), frame, seen);
  return result;
}

void run(const Task& task) {
  for (int i = 0; i < static_cast<int>(task.numbers.at("seeds")); ++i) {
    const auto seed = static_cast<std::uint64_t>(task.numbers.at("first") + i);
    const benchmark::MovementWorld world(task.world, seed);
    const auto driven = drive(world, task, seed);
    const auto surroundings = world.surroundings({});
    fmt::print("seed {}: {}\n", seed, driven.tally);
    for (const bool closes_loops : {false, true}) {
      const auto x = map_of(driven, task.slam, closes_loops, *surroundings.seen);
      fmt::print("  {}: path median {:.3f} m, most {:.3f} m; live median {:.3f} m, most {:.3f} m; "
                 "{} loops, {} doubted; {} of {} scans did not fit; {} ghosts; {:.0f} s\n",
                 closes_loops ? "with loops" : "front end ", x.path.median, x.path.most,
                 x.live_median, x.live_most, x.loops, x.doubted, x.dead_reckoned,
                 driven.scans.size(), x.ghosts, x.time);
    }
    std::fflush(stdout);
  }
}

} // namespace

} // namespace castor::slam_benchmark

int main(int argc, char** argv) {
  castor::slam_benchmark::Task task;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      const auto equals = word.find('=');
      const auto name = word.substr(0, equals);
      if (equals == word.npos)
        task.world = word;
      else if (auto* setting = castor::slam_benchmark::setting(task.slam, name))
        *setting = std::stod(word.substr(equals + 1));
      else
        task.numbers.at(name) = std::stod(word.substr(equals + 1));
    }
    castor::slam_benchmark::run(task);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
