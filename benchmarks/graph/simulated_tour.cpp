#include "castor/benchmarks/graph/simulated_tour.hpp"

#include "castor/mapping/body/free_way.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/graph/room_segments.hpp"
#include "castor/mapping/grid/keyframe_grid.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/slam.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace castor::mapping {

namespace {

constexpr double laser_height = 0.3; // m
constexpr int steps_each_scan = 10;
constexpr int most_scans = 12'000;

/// Keyframes and their poses, by SLAM or by the truth.
class Localiser {
public:
  Localiser(bool slam, const Pose2& start) : uses_slam_(slam), start_(start) {}

  std::optional<Tour::Step> add(const LaserScan& scan, const Odometry& odometry,
                                const Pose2& truth) {
    return uses_slam_ ? by_slam(scan, odometry, truth) : by_truth(scan, odometry, truth);
  }

private:
  std::optional<Tour::Step> by_slam(const LaserScan& scan, const Odometry& odometry,
                                    const Pose2& truth) {
    const auto loops = slam_.graph().size();
    auto step = slam_.add(scan, odometry.pose);
    if (!step.new_keyframe)
      return std::nullopt;
    Tour::Step result{*step.new_keyframe, truth, slam_.graph().poses(), {}};
    result.pose = result.corrected.back();
    if (loops > 0 && loops + 1 == result.corrected.size() &&
        std::equal(before_.begin(), before_.end(), result.corrected.begin()))
      result.corrected.clear();
    before_ = slam_.graph().poses();
    return result;
  }

  std::optional<Tour::Step> by_truth(const LaserScan& scan, const Odometry& odometry,
                                     const Pose2& truth) {
    const auto pose = between(start_, truth);
    if (last_ && distance(*last_, pose) < 0.15 &&
        std::abs(normalised(last_->heading - pose.heading)) < 0.12)
      return std::nullopt;
    last_ = pose;
    Keyframe x;
    x.number = number_++;
    x.time = scan.time;
    x.odometry = odometry.pose;
    x.local_pose = pose;
    x.scan = scan;
    return Tour::Step{x, truth, {}, pose};
  }

  bool uses_slam_;
  Pose2 start_;
  Slam slam_;
  std::vector<Pose2> before_;
  std::optional<Pose2> last_;
  std::int64_t number_ = 0;
};

} // namespace

Tour drive_tour(const Building& building, const std::vector<Point2>& path,
                const TourOptions& options) {
  BodyOptions body_options;
  body_options.seed = options.seed;
  body_options.people = options.people;
  body_options.laser.field_of_view = options.laser;
  body_options.laser_height = laser_height;
  SimulatedBody body(surroundings_in(building, body_options), body_options);
  PathFollower follower(path, {});
  Localiser localiser(options.slam, building.start);
  Tour result;
  for (int i = 0; i < most_scans && !follower.has_arrived(); ++i) {
    const auto scan = body.scan();
    if (auto step = localiser.add(scan, body.odometry(), body.status().pose))
      result.steps.push_back(std::move(*step));
    auto velocity = follower.velocity_at(body.status().pose);
    // It waits for people.
    constexpr double half_width = 0.27;
    constexpr double stop_before = 0.5;
    if (velocity.forward > 0 && options.people && free_way(scan, half_width) < stop_before)
      velocity = {};
    body.command(velocity);
    for (int k = 0; k < steps_each_scan; ++k)
      body.step();
  }
  result.collisions = body.status().collisions;
  result.driven = body.status().driven;
  return result;
}

double add_tour(GraphKeeper& keeper, const Tour& tour, bool rooms) {
  constexpr std::int64_t period = 10'000'000; // us
  std::int64_t last = 0;
  KeyframeGrid grid;
  const auto start = std::chrono::steady_clock::now();
  for (auto& x : tour.steps) {
    auto scan = std::make_shared<const LaserScan>(x.keyframe.scan);
    for (std::size_t i = 0; i + 1 < x.corrected.size(); ++i) {
      keeper.correct(static_cast<std::int64_t>(i), x.corrected[i]);
      if (rooms)
        grid.place(std::to_string(i), nullptr, x.corrected[i]);
    }
    keeper.add(x.keyframe.number, scan, x.keyframe.local_pose, x.pose);
    if (rooms)
      grid.place(std::to_string(x.keyframe.number), scan, x.pose);
    if (rooms && x.keyframe.time - last >= period) {
      last = x.keyframe.time;
      keeper.reconcile(room_segments(cell_map(grid.grid())));
    }
    keeper.finish();
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<Pose2> true_path(const Tour& tour) {
  std::vector<Pose2> result;
  for (auto& x : tour.steps)
    result.push_back(x.truth);
  return result;
}

std::vector<TrueDoor> doors_of(const Building& building, const std::vector<Pose2>& path,
                               const Pose2& frame) {
  const SolidObstacles walls(between_heights(solids_of(building), laser_height, laser_height));
  std::vector<TrueDoor> result;
  for (auto& door : building.doors) {
    const auto& opening = door.opening;
    TrueDoor x;
    x.name = door.name;
    const Point2 middle{(opening.from.x + opening.to.x) / 2, (opening.from.y + opening.to.y) / 2};
    x.width = door.width;
    x.is_open = door.is_open;
    x.was_seen = false;
    const auto through = std::atan2(opening.to.y - opening.from.y, opening.to.x - opening.from.x) +
                         std::numbers::pi / 2;
    for (auto& robot : path) {
      const Point2 from{robot.x, robot.y};
      const auto far = distance(from, middle);
      const auto sight = std::atan2(middle.y - from.y, middle.x - from.x);
      const bool is_frontal = std::abs(std::cos(sight - through)) > std::numbers::sqrt2 / 2;
      const bool is_ahead = std::abs(normalised(sight - robot.heading)) < 1.4;
      if (far < 3 && far > 0.5 && is_frontal && is_ahead && !walls.cast(from, sight, far)) {
        x.was_seen = true;
        break;
      }
    }
    x.middle = transform(inverse(frame), middle);
    result.push_back(x);
  }
  return result;
}

GraphQuality evaluate_nodes(const std::vector<GraphNode>& nodes, const Building& building,
                            const std::vector<Pose2>& path, const Pose2& frame) {
  auto room = [&](const Point2& p) {
    const auto* x = room_at(building, transform(frame, p));
    return x ? x->name : std::string{};
  };
  return evaluate(nodes, room, doors_of(building, path, frame));
}

void print_columns() {
  fmt::print("{:<24} places areas/rooms recall precision  doors found missed invented  "
             "error median most, m  width\n",
             "");
}

void print_quality(const std::string& name, const GraphQuality& x, const Pose2& frame) {
  fmt::print("{:<24} {:6} {:5}/{:<5} {:6.3f} {:9.3f}  {:5} {:5} {:6} {:8}  {:12.3f} {:7.3f}  "
             "{:5.3f}\n",
             name, x.places, x.areas, x.rooms, x.area_recall, x.area_precision, x.doors_seen,
             x.doors_found, x.doors_missed.size(), x.doors_invented.size(), x.door_error_median,
             x.door_error_most, x.width_error_median);
  for (auto& door : x.doors_missed)
    fmt::print("     missed {}\n", door);
  for (auto& at : x.doors_invented) {
    const auto there = transform(frame, at);
    fmt::print("     invented at {:.2f} {:.2f}\n", there.x, there.y);
  }
  std::fflush(stdout);
}

} // namespace castor::mapping
