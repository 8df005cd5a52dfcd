// How a simulated robot follows somebody through the default building, by its laser and its wheels.
//
//   follow_benchmark [SEED [RUNS [SECONDS [WALK]]]]
//
// RUNS (10) of SECONDS (120) of simulated time, with the seeds from SEED (1) on, of somebody who
// walks along the corridor, through lounge and laboratory, and again: alone; pausing at the
// corners; among four others; the same, but slower from 2 m before the robot on, and standing 4 m
// before it, as a guide does; and among four who walk through one another. The robot begins 1.5 m
// behind, follows whom it sees first, and again after it has given up. It knows its pose. Distances
// are those of the true middles, from the tenth second on; so is the share of the time in which it
// follows somebody else by mistake, and what it does while it is more than 2.5 m behind. WALK is
// alone, pauses, others, guide or heedless; without, all five.
#include "castor/benchmarks/people/scenes.hpp"
#include "castor/mapping/body/seen_obstacles.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/movement/person_follower.hpp"
#include "castor/mapping/movement/planning_map.hpp"
#include "castor/mapping/people/person_detector.hpp"
#include "castor/mapping/people/person_tracks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace mapping;

/// The building as a map that is right in every cell.
CellMap true_map(const Building& building, const BodyOptions& options) {
  const SolidObstacles obstacles{between_heights(solids_of(building), 0, options.height)};
  const auto size = extent(building);
  CellMap result;
  result.origin = {size.low.x, size.low.y, 0};
  result.columns = static_cast<int>((size.high.x - size.low.x) / result.cell_size) + 1;
  result.rows = static_cast<int>((size.high.y - size.low.y) / result.cell_size) + 1;
  for (int row = 0; row < result.rows; ++row)
    for (int column = 0; column < result.columns; ++column) {
      const Point2 middle{size.low.x + (column + 0.5) * result.cell_size,
                          size.low.y + (row + 0.5) * result.cell_size};
      const double reach = result.cell_size / 2;
      result.cells.push_back(obstacles.clearance(middle, reach) < reach ? 100 : 0);
    }
  return result;
}

/// What a robot does while it is far behind.
struct Behind {
  /// In the order in which they are looked at.
  enum What { mistaken, nobody, searches, waits, stands, slow, drives, count };
  static constexpr std::array<const char*, count> names{
    "after somebody else", "follows nobody", "searches", "lets somebody pass",
    "stands else",         "is slow",        "drives"};

  std::array<std::int64_t, count> steps{};
};

/// Metres.
constexpr double near = 2.5;

struct Result {
  std::vector<double> distances;
  Behind behind;
  /// Steps in which whom it follows is in sight, and is somebody else.
  std::int64_t mistaken = 0;
  int given_up = 0;
  std::int64_t collisions = 0;
  double moved = 0;
};

/// Follows by what is measured, and takes down the truth.
class FollowingRobot {
public:
  FollowingRobot(const Building& building, const BodyOptions& options)
    : body_(surroundings_in(building, options), options) {
    map_.update(true_map(building, options), 1);
  }

  void run(double seconds, Result& result) {
    while (body_.time().count() < static_cast<std::int64_t>(seconds * 1e6)) {
      body_.step();
      if (body_.steps() % 10 == 0)
        look();
      if (body_.steps() % 5 == 0)
        follow(result);
    }
    result.collisions += body_.status().collisions;
    result.moved += body_.status().driven;
  }

private:
  void look() {
    const auto scan = body_.scan();
    const auto now = body_.time().count();
    const auto wheels = body_.odometry().pose;
    tracks_.add(detector_.detect(scan, wheels, tracks_.expected(now)), ScanView{scan, wheels}, now);
    seen_.add(scan, body_.status().pose);
    people_.clear();
    movers_.clear();
    const auto frame = compose(body_.status().pose, inverse(wheels));
    for (const auto& x : tracks_.people()) {
      const auto tip = transform(frame, Point2{x.place.x + x.velocity.x, x.place.y + x.velocity.y});
      const auto here = transform(frame, x.place);
      movers_.push_back({here, {tip.x - here.x, tip.y - here.y}});
      constexpr double in_sight = 0.5;
      if (x.visibility < in_sight)
        continue;
      const auto place = compose(frame, {x.place.x, x.place.y, x.heading});
      people_.push_back({x.id, {place.x, place.y}, place.heading, x.speed()});
    }
  }

  void follow(Result& result) {
    const auto now = body_.time().count();
    const auto robot = body_.status().pose;
    if (!follower_ && !people_.empty())
      follower_.emplace(people_.front().id, FollowPersonOptions{});
    PersonFollower::Step step;
    if (follower_) {
      const auto seen = seen_.points();
      step = follower_->step(now, robot, people_, {map_, seen, movers_});
      if (step.status == MovementStatus::failed) {
        ++result.given_up;
        follower_.reset();
      }
    }
    body_.command(step.velocity);
    constexpr std::int64_t settled = 10'000'000;
    if (now <= settled)
      return;
    result.distances.push_back(distance(leader(), Point2{robot.x, robot.y}));
    result.mistaken += is_mistaken() ? 1 : 0;
    if (result.distances.back() > near)
      ++result.behind.steps[what(step)];
  }

  Behind::What what(const PersonFollower::Step& step) const {
    constexpr double standing = 0.03; // m/s
    constexpr double slow = 0.36;
    if (!follower_)
      return Behind::nobody;
    if (is_mistaken())
      return Behind::mistaken;
    if (step.waits_for == "somebody to pass")
      return Behind::waits;
    if (step.status == MovementStatus::recovering)
      return Behind::searches;
    if (step.velocity.forward < standing)
      return Behind::stands;
    return step.velocity.forward < slow ? Behind::slow : Behind::drives;
  }

  Point2 leader() const { return body_.people().discs()[0].centre; }

  bool is_mistaken() const {
    constexpr double one_person = 0.7; // metres
    return follower_ && std::ranges::any_of(people_, [&](const SeenPerson& x) {
             return x.id == follower_->person() && distance(x.place, leader()) > one_person;
           });
  }

  SimulatedBody body_;
  PersonDetector detector_{{}};
  PersonTracks tracks_{{}};
  PlanningMap map_;
  SeenObstacles seen_;
  std::vector<SeenPerson> people_;
  std::vector<Mover> movers_;
  std::optional<PersonFollower> follower_;
};

void measure(const std::string& name, std::uint64_t seed, int runs, double seconds) {
  Result result;
  for (int i = 0; i < runs; ++i) {
    BodyOptions options;
    options.people = true;
    options.legs = true;
    options.considerate = name != "heedless";
    options.laser.beams_per_degree = 2;
    options.seed = seed + static_cast<std::uint64_t>(i);
    FollowingRobot robot{walk_to_follow(name, options.seed), options};
    robot.run(seconds, result);
  }
  auto& all = result.distances;
  std::ranges::sort(all);
  const auto quantile = [&](double share) {
    return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
  };
  const auto with = std::ranges::upper_bound(all, near) - all.begin();
  fmt::print("{:<9}{:>8.2f}{:>8.2f}{:>8.2f}{:>8.2f}{:>14.1f}{:>12.1f}{:>10}{:>11}{:>10.0f}\n", name,
             std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size()),
             quantile(0.5), quantile(0.95), all.front(),
             100.0 * static_cast<double>(with) / static_cast<double>(all.size()),
             100.0 * static_cast<double>(result.mistaken) / static_cast<double>(all.size()),
             result.given_up, result.collisions, result.moved);
  const auto total = static_cast<double>(all.size());
  for (std::size_t i = 0; i < Behind::count; ++i)
    if (result.behind.steps[i] > 0)
      fmt::print("    behind: {:<20}{:>6.1f} %\n", Behind::names[i],
                 100.0 * static_cast<double>(result.behind.steps[i]) / total);
  std::fflush(stdout);
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  const auto seed = static_cast<std::uint64_t>(argc > 1 ? std::max(0LL, std::atoll(argv[1])) : 1);
  const int runs = argc > 2 ? std::max(1, std::atoi(argv[2])) : 10;
  const double seconds = argc > 3 ? std::max(20.0, std::atof(argv[3])) : 120;
  fmt::print("{:<9}{:>8}{:>8}{:>8}{:>8}{:>14}{:>12}{:>10}{:>11}{:>10}\n", "", "mean m", "median",
             "p95", "least", "within 2.5 m %", "mistaken %", "given up", "collisions", "driven m");
  const std::string walk = argc > 4 ? argv[4] : "";
  for (const auto* name : {"alone", "pauses", "others", "guide", "heedless"})
    if (walk.empty() || walk == name)
      castor::benchmark::measure(name, seed, runs, seconds);
}
