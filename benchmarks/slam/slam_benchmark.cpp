// How accurate the path of a robot is that SLAM makes of its log, by the metric of the SLAM
// benchmark.
//
//     slam_benchmark LOG [RELATIONS] [OPTION=NUMBER...]
//
// LOG is a CARMEN log or an MRPT rawlog, RELATIONS a file of relations of the SLAM benchmark; both
// may be compressed. Options make the task harder, to see how robust the settings are: beams=N
// takes each Nth beam, scans=N each Nth scan, noise=SIGMA adds noise to ranges (m), drift=SHARE to
// odometry, seed=N; density=FACTOR multiplies the distance of keyframes; loops=0 leaves out loop
// closing; icp=1 aligns scans by ICP of MRPT, a baseline; worst=1 lists the relations that are kept
// worst. Settings of SLAM are changed by their names, such as keyframe_distance=0.3; see setting().
// path=FILE writes the path: time x y heading; truth=FILE has the true one, to compare it with.

#include "castor/benchmarks/slam/relations.hpp"
#include "castor/benchmarks/slam/slam_settings.hpp"
#include "castor/mapping/logs/robot_log_file.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/slam.hpp"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace castor;

struct Task {
  std::string log;
  std::string relations;
  std::string path;
  std::string truth;
  std::size_t beams = 1;
  std::size_t scans = 1;
  double noise = 0;
  double drift = 0;
  bool shows_worst = false;
  unsigned seed = 1;
  mapping::SlamOptions options;
};

bool set_option(Task& task, std::string_view name, const std::string& value) {
  auto number = std::atof(value.c_str());
  auto count = static_cast<std::size_t>(std::max(number, 1.));
  if (name == "beams")
    task.beams = count;
  else if (name == "scans")
    task.scans = count;
  else if (name == "noise")
    task.noise = number;
  else if (name == "drift")
    task.drift = number;
  else if (name == "seed")
    task.seed = static_cast<unsigned>(number);
  else if (name == "worst")
    task.shows_worst = number != 0;
  else if (name == "loops")
    task.options.closes_loops = number != 0;
  else if (name == "icp")
    task.options.front_end.method =
      number != 0 ? mapping::MatchingMethod::icp : mapping::MatchingMethod::point_to_line;
  else if (name == "path")
    task.path = value;
  else if (name == "truth")
    task.truth = value;
  else if (name == "density") {
    task.options.front_end.keyframe_distance *= number;
    task.options.front_end.keyframe_turn *= number;
  } else if (auto* value_of = slam_benchmark::setting(task.options, name)) {
    *value_of = number;
  } else {
    return false;
  }
  return true;
}

// Log with the chosen beams and scans, and with noise.
std::vector<mapping::LoggedScan> made_harder(const mapping::RobotLog& log, const Task& task) {
  std::mt19937 random(task.seed);
  std::normal_distribution<double> normal;
  std::vector<mapping::LoggedScan> result;
  mapping::Pose2 before;
  for (std::size_t i = 0; i < log.scans.size(); i += task.scans) {
    auto x = log.scans[i];
    std::vector<float> ranges;
    for (std::size_t b = 0; b < x.scan.ranges.size(); b += task.beams) {
      auto range = x.scan.ranges[b];
      if (range > 0 && task.noise > 0)
        range = std::max(0.F, range + static_cast<float>(task.noise * normal(random)));
      ranges.push_back(range);
    }
    x.scan.ranges = std::move(ranges);
    x.scan.angle_step *= static_cast<double>(task.beams);
    auto odometry = x.odometry.pose;
    if (i > 0 && task.drift > 0) {
      auto step = mapping::between(before, odometry);
      auto way = task.drift * (std::hypot(step.x, step.y) + 0.2 * std::abs(step.heading));
      step.x += way * normal(random);
      step.y += way * normal(random);
      step.heading += way * normal(random);
      x.odometry.pose = mapping::compose(result.back().odometry.pose, step);
    }
    before = odometry;
    result.push_back(std::move(x));
  }
  return result;
}

void print_diagnostics(const std::vector<Diagnostic>& diagnostics) {
  fmt::print(stderr, "{}", render(diagnostics));
}

// Relations that the path is furthest from, with their time in the log.
void print_worst(const std::vector<slam_benchmark::TimedPose>& path,
                 const std::vector<slam_benchmark::Relation>& relations) {
  std::vector<std::pair<double, const slam_benchmark::Relation*>> worst;
  for (const auto& x : relations)
    worst.emplace_back(slam_benchmark::relation_errors(path, {x}).translation.mean, &x);
  std::sort(worst.rbegin(), worst.rend());
  worst.resize(std::min<std::size_t>(worst.size(), 12));
  for (const auto& [error, x] : worst)
    fmt::print("    {:.3f} m: from {:.3f} s to {:.3f} s, which are {:.2f} m apart\n", error,
               static_cast<double>(x->from - path.front().time) / 1e6,
               static_cast<double>(x->to - path.front().time) / 1e6,
               std::hypot(x->pose.x, x->pose.y));
}

int run(const Task& task) {
  auto read = mapping::read_robot_log(task.log);
  print_diagnostics(read.diagnostics);
  if (!read.log)
    return 2;
  auto scans = made_harder(*read.log, task);
  using Clock = std::chrono::steady_clock;
  auto start = Clock::now();
  mapping::Slam slam{task.options};
  for (const auto& x : scans) {
    auto step = slam.add(x.scan, x.odometry.pose);
    if (task.shows_worst && !step.reason.empty())
      fmt::print("    {:.3f} s: {}\n",
                 static_cast<double>(x.logged_time - scans.front().logged_time) / 1e6, step.reason);
  }
  slam.finish();
  auto seconds = std::chrono::duration<double>(Clock::now() - start).count();
  auto length = static_cast<double>(scans.back().scan.time - scans.front().scan.time) / 1e6;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("{}: {} scans, {} keyframes, {} loops ({} doubted), {} scans did not fit\n", task.log,
             scans.size(), slam.graph().size(), slam.graph().loops(), slam.graph().doubted_loops(),
             slam.dead_reckoned());
  fmt::print("  {:.1f} s for {:.0f} s: {:.1f} x real time, {:.2f} ms per scan, {} MB\n", seconds,
             length, length / seconds, 1e3 * seconds / static_cast<double>(scans.size()),
             usage.ru_maxrss / 1024);
  std::vector<slam_benchmark::TimedPose> path;
  // Relations name scans by their times in the log.
  auto poses = slam.path();
  for (std::size_t i = 0; i < poses.size(); ++i)
    path.push_back({scans[i].logged_time, poses[i].pose});
  std::stable_sort(path.begin(), path.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  if (!task.path.empty()) {
    std::ofstream out(task.path);
    for (const auto& x : path)
      out << fmt::format("{:.6f} {:.4f} {:.4f} {:.5f}\n", static_cast<double>(x.time) / 1e6,
                         x.pose.x, x.pose.y, x.pose.heading);
  }
  if (!task.truth.empty()) {
    auto truth = slam_benchmark::read_path(task.truth);
    print_diagnostics(truth.diagnostics);
    if (!truth.path)
      return 2;
    auto errors = slam_benchmark::trajectory_errors(path, *truth.path);
    fmt::print("  from the truth, aligned, at {} poses: root mean square {:.3f} m, median {:.3f}, "
               "most {:.3f}\n",
               errors.poses, errors.root_mean_square, errors.median, errors.most);
  }
  if (task.relations.empty())
    return 0;
  auto relations = slam_benchmark::read_relations(task.relations);
  print_diagnostics(relations.diagnostics);
  if (!relations.relations)
    return 2;
  auto errors = slam_benchmark::relation_errors(path, *relations.relations);
  constexpr double degrees = 57.29577951308232;
  fmt::print("  {} relations ({} at times without a pose)\n", errors.relations,
             errors.without_pose);
  fmt::print("  absolute translation {:.4f} +- {:.4f} m (most {:.2f}), rotation {:.3f} +- {:.3f} "
             "degrees (most {:.1f})\n",
             errors.translation.mean, errors.translation.deviation, errors.translation.most,
             degrees * errors.rotation.mean, degrees * errors.rotation.deviation,
             degrees * errors.rotation.most);
  if (task.shows_worst)
    print_worst(path, *relations.relations);
  fmt::print("  squared translation {:.5f} +- {:.5f} m2, rotation {:.3f} +- {:.3f} degrees2\n",
             errors.squared_translation.mean, errors.squared_translation.deviation,
             degrees * degrees * errors.squared_rotation.mean,
             degrees * degrees * errors.squared_rotation.deviation);
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  Task task;
  for (int i = 1; i < argc; ++i) {
    std::string argument = argv[i];
    auto equals = argument.find('=');
    if (equals != std::string::npos) {
      if (!set_option(task, argument.substr(0, equals), argument.substr(equals + 1))) {
        fmt::print(stderr, "there is no option {}\n", argument);
        return 2;
      }
    } else if (task.log.empty()) {
      task.log = argument;
    } else {
      task.relations = argument;
    }
  }
  if (task.log.empty()) {
    fmt::print(stderr, "usage: {} LOG [RELATIONS] [OPTION=NUMBER...]\n", argv[0]);
    return 2;
  }
  try {
    return run(task);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
