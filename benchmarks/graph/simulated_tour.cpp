#include "castor/benchmarks/graph/simulated_tour.hpp"

#include "castor/mapping/body/free_way.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/slam.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
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

double add_tour(GraphKeeper& keeper, const Tour& tour) {
  const auto start = std::chrono::steady_clock::now();
  for (auto& x : tour.steps) {
    auto scan = std::make_shared<const LaserScan>(x.keyframe.scan);
    for (std::size_t i = 0; i + 1 < x.corrected.size(); ++i)
      keeper.correct(static_cast<std::int64_t>(i), x.corrected[i]);
    keeper.add(x.keyframe.number, scan, x.keyframe.local_pose, x.pose);
    keeper.finish();
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<TrueDoor> doors_of(const Building& building, const Tour& tour) {
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
    for (auto& step : tour.steps) {
      const Point2 from{step.truth.x, step.truth.y};
      const auto far = distance(from, middle);
      const auto sight = std::atan2(middle.y - from.y, middle.x - from.x);
      const bool is_frontal = std::abs(std::cos(sight - through)) > std::numbers::sqrt2 / 2;
      const bool is_ahead = std::abs(normalised(sight - step.truth.heading)) < 1.4;
      if (far < 3 && far > 0.5 && is_frontal && is_ahead && !walls.cast(from, sight, far)) {
        x.was_seen = true;
        break;
      }
    }
    x.middle = transform(inverse(building.start), middle);
    result.push_back(x);
  }
  return result;
}

GraphQuality evaluate_tour(const GraphKeeper& keeper, const Building& building, const Tour& tour) {
  std::vector<GraphNode> nodes;
  for (auto& [id, x] : keeper.graph().nodes())
    nodes.push_back(x);
  auto room = [&](const Point2& p) {
    const auto* x = room_at(building, transform(building.start, p));
    return x ? x->name : std::string{};
  };
  return evaluate(nodes, room, doors_of(building, tour));
}

} // namespace castor::mapping
