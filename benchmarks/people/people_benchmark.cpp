// How well people are tracked in the scans of a simulated robot, which knows the truth.
//
//   people_benchmark [SCENE|all [SEED [RUNS [SECONDS [legs|discs [BEAMS
//     [considerate|heedless]]]]]]]
//
// RUNS (10) of SECONDS (60) of simulated time in each scene (scenes.hpp), with the seeds from SEED
// (1) on: they determine routes, speeds and noise. A laser of 180 degrees, BEAMS (2) a degree,
// 10 Hz, sees people's legs, or discs. They keep clear of one another, or walk through one another.
// A person is visible if the middle of the body is, within 8 m of the laser and its field of view.
#include "castor/benchmarks/people/scenes.hpp"
#include "castor/benchmarks/people/tracking_score.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/people/person_detector.hpp"
#include "castor/mapping/people/person_tracks.hpp"
#include "castor/mapping/safety/safety_rules.hpp"

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
#include <vector>

namespace castor::benchmark {

namespace {

using namespace mapping;

constexpr double seen_up_to = 8; // metres

/// Rounds along the path, if there is one.
class Driver {
public:
  explicit Driver(const Path& path) : path_(path) {}

  std::optional<Twist2> velocity_at(const Pose2& pose) {
    if (path_.empty())
      return std::nullopt;
    if (!follower_ || follower_->has_arrived())
      follower_.emplace(path_, FollowOptions{});
    return follower_->velocity_at(pose);
  }

private:
  Path path_;
  std::optional<PathFollower> follower_;
};

bool is_visible(const Obstacles& fixed, const LaserScan& scan, const Pose2& robot,
                const Point2& person) {
  const auto scanner = compose(robot, scan.mount);
  const auto seen = transform(inverse(scanner), person);
  const double range = std::hypot(seen.x, seen.y);
  const double direction = std::atan2(seen.y, seen.x);
  if (range > seen_up_to || std::abs(direction) > std::abs(scan.first_angle))
    return false;
  return !fixed.cast({scanner.x, scanner.y}, scanner.heading + direction, range);
}

struct Run {
  TrackingScore score;
  std::int64_t collisions = 0;
  double seconds_of_work = 0;
  std::int64_t scans = 0;
};

void run(const Scene& place, const BodyOptions& options, double seconds, Run& result) {
  SimulatedBody body{surroundings_in(place.building, options), options};
  const SolidObstacles fixed{
    between_heights(solids_of(place.building), options.laser_height, options.laser_height)};
  SafetyRules rules{{}};
  PersonDetector detector{{}};
  PersonTracks tracks{{}};
  Driver driver{place.path};
  TrackingScore score;
  const auto steps = static_cast<std::int64_t>(seconds * 100);
  for (std::int64_t step = 1; step <= steps; ++step) {
    body.step();
    const auto now = body.time().count();
    rules.add(body.odometry(), now);
    if (step % 5 == 0)
      body.command(rules.verdict(driver.velocity_at(body.status().pose), now).velocity);
    if (step % 10 != 0)
      continue;
    const auto scan = body.scan();
    rules.add(scan, now);
    const auto wheels = body.odometry().pose;
    const auto begin = std::chrono::steady_clock::now();
    tracks.add(detector.detect(scan, wheels, tracks.expected(now)), ScanView{scan, wheels}, now);
    result.seconds_of_work +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ++result.scans;
    const auto truth = body.status().pose;
    std::vector<TrackingScore::Truth> people;
    for (const auto& x : body.people().discs())
      people.push_back({x.centre, is_visible(fixed, scan, truth, x.centre)});
    // Wheels drift; where people are as seen from the robot is compared.
    auto tracked = tracks.people();
    for (auto& x : tracked)
      x.place = transform(truth, transform(inverse(wheels), x.place));
    score.add(people, tracked, static_cast<double>(now) * 1e-6);
  }
  auto& sum = result.score;
  sum.visible += score.visible;
  sum.missed += score.missed;
  sum.error += score.error;
  sum.matches += score.matches;
  sum.crossings += score.crossings;
  sum.kept += score.kept;
  sum.switches += score.switches;
  sum.false_tracks += score.false_tracks;
  result.collisions += body.status().collisions;
}

struct Settings {
  std::uint64_t seed = 1;
  int runs = 10;
  double seconds = 60;
  bool legs = true;
  int beams = 2;
  bool considerate = true;
};

void measure(const std::string& name, const Settings& settings) {
  Run result;
  for (int i = 0; i < settings.runs; ++i) {
    BodyOptions options;
    options.people = true;
    options.legs = settings.legs;
    options.considerate = settings.considerate;
    options.laser.beams_per_degree = settings.beams;
    options.seed = settings.seed + static_cast<std::uint64_t>(i);
    run(scene(name, options.seed), options, settings.seconds, result);
  }
  const auto& x = result.score;
  const double minutes = settings.seconds * settings.runs / 60;
  const auto percent = [](auto part, auto all) {
    return 100.0 * static_cast<double>(part) / std::max(1.0, static_cast<double>(all));
  };
  fmt::print("{:<10}{:>10}{:>8.1f}{:>10.1f}{:>14.2f}{:>11.2f}{:>9.3f}{:>9.2f}{:>11}\n", name,
             x.crossings, percent(x.kept, x.crossings), percent(x.missed, x.visible),
             x.switches / minutes, x.false_tracks / minutes,
             x.error / std::max(1.0, static_cast<double>(x.matches)),
             1000 * result.seconds_of_work / static_cast<double>(result.scans), result.collisions);
  std::fflush(stdout);
}

int run_all(int argc, char** argv) {
  const std::string which = argc > 1 ? argv[1] : "all";
  Settings settings;
  if (argc > 2)
    settings.seed = static_cast<std::uint64_t>(std::max(0LL, std::atoll(argv[2])));
  if (argc > 3)
    settings.runs = std::max(1, std::atoi(argv[3]));
  if (argc > 4)
    settings.seconds = std::max(1.0, std::atof(argv[4]));
  if (argc > 5)
    settings.legs = std::string{argv[5]} != "discs";
  if (argc > 6)
    settings.beams = std::max(1, std::atoi(argv[6]));
  if (argc > 7)
    settings.considerate = std::string{argv[7]} != "heedless";
  if (which != "all")
    scene(which, settings.seed); // refuses unknown names
  fmt::print("{:<10}{:>10}{:>8}{:>10}{:>14}{:>11}{:>9}{:>9}{:>11}\n", "", "crossings", "kept %",
             "missed %", "switches/min", "false/min", "error m", "ms/scan", "collisions");
  for (const auto& name : scene_names())
    if (which == "all" || which == name)
      measure(name, settings);
  return 0;
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  try {
    return castor::benchmark::run_all(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "people_benchmark: {}\n", e.what());
    return 1;
  }
}
