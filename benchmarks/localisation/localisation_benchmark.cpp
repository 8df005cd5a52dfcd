// How well a robot finds out where it is in a map, and stays to know it: a simulated robot drives
// about in the map, from a random place for each seed.
//
//     localisation_benchmark MAP.yaml [OPTION=NUMBER...]
//
// seeds=N runs of seconds=N each, the first with seed=N. After kidnap=N seconds somebody carries
// the robot to another random place; 0: never. known=1 tells the localiser where the robot begins;
// building=MAP.yaml has the walls, where the map was made of it by a robot; boxes=N puts N boxes
// that the map does not have into the building, other ones for each seed, and people=N lets so many
// walk there; worst=1 prints what happens in each run. Settings of the localiser: beams, hit,
// random, least, most, density, near, explained; see set_option().

#include "castor/benchmarks/localisation/wandering_robot.hpp"
#include "castor/mapping/localisation/monte_carlo_localiser.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace castor;

struct Task {
  std::string map;
  std::string truth;
  std::uint64_t seed = 1;
  std::uint64_t seeds = 20;
  double seconds = 150;
  double kidnapped_at = 60;
  int boxes = 0;
  int people = 0;
  bool is_start_known = false;
  bool shows_runs = false;
  mapping::MonteCarloOptions options;
};

/// Position errors of at most this are those of a robot that was found, m.
constexpr double right_within = 0.5;

/// What happened in one run.
struct Run {
  /// Seconds from the beginning until the robot was said to be found, and whether it was there.
  std::optional<double> found;
  bool found_right = false;
  /// Seconds from the kidnapping until it was noticed, and until the robot was found again.
  std::optional<double> noticed;
  std::optional<double> found_again;
  bool found_again_right = false;
  /// Lost without a kidnapping.
  int lost = 0;
  /// Scans in which the state was tracking, and those of them at a wrong place.
  std::int64_t tracked = 0;
  std::int64_t wrong = 0;
  std::int64_t scans = 0;
};

struct Figures {
  std::vector<double> distances;
  std::vector<double> turns;
  std::vector<double> explained;
  double computed = 0;
  double longest = 0;
};

double share_of(std::vector<double>& sorted, double share) {
  return sorted.empty()
           ? 0
           : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

Run run(const Task& task, const mapping::CellMap& map, const mapping::CellMap& mapped_building,
        std::uint64_t seed, Figures& figures) {
  const auto building = localisation_benchmark::with_boxes(mapped_building, task.boxes, seed);
  using Clock = std::chrono::steady_clock;
  constexpr double radius = 0.25;
  localisation_benchmark::WanderOptions wander;
  wander.seed = seed;
  wander.people = task.people;
  localisation_benchmark::WanderingRobot robot{
    building, localisation_benchmark::random_place(building, radius, seed), wander};
  auto options = task.options;
  options.filter.seed = seed;
  std::optional<mapping::Pose2> start;
  if (task.is_start_known)
    start = robot.truth();
  mapping::MonteCarloLocaliser localiser{map, start, options};
  Run result;
  bool is_kidnapped = false;
  auto state = mapping::LocalisationState::starting;
  using enum mapping::LocalisationState;
  for (double time = 0.1; time < task.seconds; time += 0.1) {
    if (task.kidnapped_at > 0 && !is_kidnapped && time >= task.kidnapped_at) {
      robot.kidnap(localisation_benchmark::random_place(building, radius, seed + 1000));
      is_kidnapped = true;
    }
    robot.drive();
    auto begin = Clock::now();
    auto step = localiser.add(robot.scan(), robot.odometry());
    auto took = std::chrono::duration<double>(Clock::now() - begin).count();
    figures.computed += took;
    figures.longest = std::max(figures.longest, took);
    auto off = distance(step.pose, robot.truth());
    auto is_right = off <= right_within;
    ++result.scans;
    if (step.state == tracking) {
      ++result.tracked;
      result.wrong += is_right ? 0 : 1;
      figures.explained.push_back(step.explained);
      if (is_right) {
        figures.distances.push_back(off);
        figures.turns.push_back(
          std::abs(mapping::normalised(step.pose.heading - robot.truth().heading)));
      }
    }
    if (step.state == tracking && state != tracking && !result.found) {
      result.found = time;
      result.found_right = is_right;
    }
    if (step.state == lost && state != lost) {
      if (is_kidnapped && !result.noticed)
        result.noticed = time - task.kidnapped_at;
      else
        ++result.lost;
    }
    if (step.state == tracking && state == lost && result.noticed && !result.found_again) {
      result.found_again = time - task.kidnapped_at;
      result.found_again_right = is_right;
    }
    if (task.shows_runs && step.state != state)
      fmt::print("    seed {} {:.1f} s: state {}, off {:.2f} m: {}\n", seed, time,
                 static_cast<int>(step.state), off, step.reason);
    state = step.state;
  }
  return result;
}

void print_times(const char* what, std::size_t runs, std::vector<double> times, int wrong) {
  std::ranges::sort(times);
  fmt::print(
    "  {}: {} of {}, {} of them at a wrong place; after {:.1f} s (median), {:.1f} s at most\n",
    what, times.size(), runs, wrong, share_of(times, 0.5), share_of(times, 1));
}

int run_all(const Task& task) {
  auto map = mapping::read_map_server(task.map);
  auto building = task.truth.empty() ? map : mapping::read_map_server(task.truth);
  Figures figures;
  std::vector<double> found;
  std::vector<double> noticed;
  std::vector<double> found_again;
  int wrong = 0;
  int wrong_again = 0;
  int lost = 0;
  std::int64_t tracked = 0;
  std::int64_t wrong_scans = 0;
  std::int64_t scans = 0;
  for (auto seed = task.seed; seed < task.seed + task.seeds; ++seed) {
    auto x = run(task, map, building, seed, figures);
    if (x.found)
      found.push_back(*x.found);
    wrong += x.found && !x.found_right ? 1 : 0;
    if (x.noticed)
      noticed.push_back(*x.noticed);
    if (x.found_again)
      found_again.push_back(*x.found_again);
    wrong_again += x.found_again && !x.found_again_right ? 1 : 0;
    lost += x.lost;
    tracked += x.tracked;
    wrong_scans += x.wrong;
    scans += x.scans;
  }
  fmt::print("{}: {} runs of {:.0f} s\n", task.map, task.seeds, task.seconds);
  print_times("found", task.seeds, found, wrong);
  if (task.kidnapped_at > 0) {
    print_times("kidnapping noticed", task.seeds, noticed, 0);
    print_times("found again after it", task.seeds, found_again, wrong_again);
  }
  fmt::print("  lost at other times: {}\n", lost);
  auto percent = [](auto part, auto whole) {
    return whole == 0 ? 0. : 100. * static_cast<double>(part) / static_cast<double>(whole);
  };
  fmt::print("  tracking in {:.1f} % of {} scans, {:.2f} % of these at a wrong place\n",
             percent(tracked, scans), scans, percent(wrong_scans, tracked));
  std::ranges::sort(figures.distances);
  std::ranges::sort(figures.turns);
  std::ranges::sort(figures.explained);
  constexpr double degrees = 57.29577951308232;
  fmt::print("  error while tracking: {:.3f} m (median), {:.3f} (95 %), {:.3f} at most; {:.2f} "
             "degrees, {:.2f}, {:.2f}\n",
             share_of(figures.distances, 0.5), share_of(figures.distances, 0.95),
             share_of(figures.distances, 1), degrees * share_of(figures.turns, 0.5),
             degrees * share_of(figures.turns, 0.95), degrees * share_of(figures.turns, 1));
  fmt::print("  explained while tracking: {:.2f} (median), {:.2f} (1 %)\n",
             share_of(figures.explained, 0.5), share_of(figures.explained, 0.01));
  fmt::print("  {:.2f} ms for a scan, {:.0f} ms at most\n",
             1e3 * figures.computed / static_cast<double>(std::max<std::int64_t>(1, scans)),
             1e3 * figures.longest);
  return 0;
}

bool set_option(Task& task, std::string_view name, const std::string& value) {
  auto number = std::atof(value.c_str());
  auto& x = task.options;
  if (name == "seeds")
    task.seeds = static_cast<std::uint64_t>(number);
  else if (name == "seed")
    task.seed = static_cast<std::uint64_t>(number);
  else if (name == "seconds")
    task.seconds = number;
  else if (name == "kidnap")
    task.kidnapped_at = number;
  else if (name == "boxes")
    task.boxes = static_cast<int>(number);
  else if (name == "people")
    task.people = static_cast<int>(number);
  else if (name == "known")
    task.is_start_known = number != 0;
  else if (name == "worst")
    task.shows_runs = number != 0;
  else if (name == "building")
    task.truth = value;
  else if (name == "beams")
    x.filter.beams = static_cast<std::size_t>(number);
  else if (name == "hit")
    x.filter.hit_deviation = number;
  else if (name == "random")
    x.filter.random_beams = number;
  else if (name == "least")
    x.filter.least_particles = static_cast<unsigned>(number);
  else if (name == "most")
    x.filter.most_particles = static_cast<unsigned>(number);
  else if (name == "density")
    x.search_density = number;
  else if (name == "near")
    x.fit.near = number;
  else if (name == "explained")
    x.monitor.least_explained = number;
  else
    return false;
  return true;
}

} // namespace

int main(int argc, char** argv) {
  Task task;
  for (int i = 1; i < argc; ++i) {
    std::string argument = argv[i];
    auto equals = argument.find('=');
    if (equals == std::string::npos) {
      task.map = argument;
    } else if (!set_option(task, argument.substr(0, equals), argument.substr(equals + 1))) {
      fmt::print(stderr, "there is no option {}\n", argument);
      return 2;
    }
  }
  if (task.map.empty()) {
    fmt::print(stderr, "usage: {} MAP.yaml [OPTION=NUMBER...]\n", argv[0]);
    return 2;
  }
  try {
    return run_all(task);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
