// How well people are tracked in the scans of a simulated robot, which knows the truth.
//
//   people_benchmark [SECONDS [SEEDS]]
//
// SECONDS (300) of simulated time for each of SEEDS (5) in: a hall where eight people cross before
// a robot that stands; the office with a robot that stands in the corridor; and the office with a
// robot that drives its path. Laser of 180 degrees, a beam per degree or two, 10 Hz. A person is
// visible if the middle of the body is, within 8 m of the laser and its field of view.
#include "castor/base/text_file.hpp"
#include "castor/benchmarks/people/tracking_score.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/people/person_detector.hpp"
#include "castor/mapping/people/person_tracks.hpp"
#include "castor/mapping/safety/safety_rules.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace mapping;

constexpr double seen_up_to = 8; // metres

const char* const hall = "wall 0 0 to 12 0 to 12 8 to 0 8 close\n"
                         "furniture table at 6 1 box 1.2 0.8 0.7 legs\n"
                         "furniture shelf at 11.5 4 box 0.5 2 2\n"
                         "person a route 2 2 to 9 6.5 speed 0.9\n"
                         "person b route 2 6 to 9 1.8 speed 0.8\n"
                         "person c route 4 1.5 to 4 7 speed 1.1\n"
                         "person d route 7 7 to 7 2 speed 0.7\n"
                         "person e route 3 4.2 to 10 4.2 speed 0.6\n"
                         "person f route 10 3.8 to 3 3.8 speed 1\n"
                         "person g route 5.5 2 to 5.5 7 to 8.5 7 to 8.5 2 loop speed 1.2\n"
                         "person h route 9 5 to 4 5 speed 0.5\n"
                         "start 1 4\n";

struct Place {
  std::string name;
  Building building;
  /// Where the robot drives; it stands if empty.
  Path path;
};

std::vector<Place> places() {
  const std::string configs = CASTOR_CONFIGS;
  std::vector<Place> result;
  result.push_back({"hall, 8 people, robot stands", parse_building(hall, "hall").building, {}});
  auto office = load_building(configs + "/buildings/office.building").building;
  result.push_back({"office, 2 people, robot stands", office, {}});
  const auto path = configs + "/buildings/office.path";
  result.push_back(
    {"office, 2 people, robot drives", office, parse_path(load_text(path), path).path});
  return result;
}

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

void run(const Place& place, const BodyOptions& options, double seconds, Run& result) {
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
    tracks.add(detector.detect(scan, wheels, tracks.expected(now)), now);
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

void measure(const Place& place, bool legs, int beams, double seconds, int seeds) {
  Run result;
  for (int seed = 1; seed <= seeds; ++seed) {
    BodyOptions options;
    options.people = true;
    options.legs = legs;
    options.laser.beams_per_degree = beams;
    options.seed = static_cast<std::uint64_t>(seed);
    run(place, options, seconds, result);
  }
  const auto& x = result.score;
  const double minutes = seconds * seeds / 60;
  fmt::print("{:<32}{:<6}{:>6}{:>11}{:>7}{:>10.1f}{:>14.2f}{:>15.2f}{:>9.2f}{:>9.2f}{:>11}\n",
             place.name, legs ? "legs" : "discs", beams, x.crossings, x.kept,
             100.0 * static_cast<double>(x.missed) /
               static_cast<double>(std::max<std::int64_t>(1, x.visible)),
             x.switches / minutes, x.false_tracks / minutes,
             x.error / static_cast<double>(std::max<std::int64_t>(1, x.matches)),
             1000 * result.seconds_of_work / static_cast<double>(result.scans), result.collisions);
  std::fflush(stdout);
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  const double seconds = argc > 1 ? std::max(1.0, std::atof(argv[1])) : 300;
  const int seeds = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
  fmt::print("{:<32}{:<6}{:>6}{:>11}{:>7}{:>10}{:>14}{:>15}{:>9}{:>9}{:>11}\n", "", "seen", "beams",
             "crossings", "kept", "missed %", "switches/min", "false/min", "error m", "ms/scan",
             "collisions");
  for (const auto& place : places())
    for (const bool legs : {false, true})
      for (const int beams : {1, 2})
        measure(place, legs, beams, seconds, seeds);
}
