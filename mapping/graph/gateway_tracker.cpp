#include "castor/mapping/graph/gateway_tracker.hpp"

#include "castor/mapping/planar/beam_towards.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace castor::mapping {

namespace {

constexpr double half_turn = std::numbers::pi;

/// Difference of two directions that may be opposite to one another, within [0, pi / 2].
double difference_of_lines(double a, double b) {
  auto x = std::abs(normalised(a - b));
  return std::min(x, half_turn - x);
}

/// Range towards a point of the map: the longest of the nearest three beams; 0 if
/// the point is out of sight or nothing came back.
double range_towards(const LaserScan& scan, const Pose2& scanner, const Point2& point) {
  const auto beam = beam_towards(scan, transform(inverse(scanner), point));
  if (!beam)
    return 0;
  double result = 0;
  for (auto i = *beam - 1; i <= *beam + 1; ++i)
    result = std::max(result, double{scan.ranges[i]});
  return result;
}

} // namespace

Line2 Gateway::line() const {
  auto right = transform(pose, {0, -width / 2});
  auto left = transform(pose, {0, width / 2});
  return {right, left};
}

bool GatewayTracker::is_same(const Pose2& a, const Pose2& b) const {
  return distance(a, b) <= options_.near &&
         difference_of_lines(a.heading, b.heading) <= options_.turned;
}

void GatewayTracker::add(std::int64_t keyframe, const Pose2& robot, const LaserScan& scan,
                         const std::vector<Opening>& openings) {
  std::vector<std::int64_t> seen;
  for (auto& opening : openings) {
    const auto on_robot = opening.pose();
    const auto in_map = compose(robot, on_robot);
    std::int64_t best = -1;
    for (auto& [id, x] : gateways_)
      if (is_same(x.pose, in_map) &&
          (best < 0 || distance(x.pose, in_map) < distance(gateways_[best].pose, in_map)))
        best = id;
    if (best < 0) {
      best = next_id_++;
      gateways_[best].id = best;
    }
    auto& evidence = evidence_[best];
    // Beams are apart in proportion to the distance.
    const auto far = std::hypot(on_robot.x, on_robot.y);
    evidence.views.push_back({keyframe, on_robot, opening.width(), robot, 1 / (0.1 + far * far)});
    count_hit(evidence, robot);
    if (evidence.views.size() > options_.most_views)
      evidence.views.erase(std::ranges::min_element(evidence.views, {}, &View::weight));
    summarise(best);
    seen.push_back(best);
  }
  for (auto& [id, x] : evidence_) {
    if (std::ranges::find(seen, id) != seen.end())
      continue;
    count_miss(x, gateways_[id], robot, scan);
    summarise(id);
  }
}

void GatewayTracker::count_hit(Evidence& x, const Pose2& robot) const {
  const Point2 from{robot.x, robot.y};
  if (x.hits > 0 && distance(from, x.last_hit_from) < options_.apart)
    return;
  ++x.hits;
  x.last_hit_from = from;
}

void GatewayTracker::count_miss(Evidence& x, const Gateway& gateway, const Pose2& robot,
                                const LaserScan& scan) const {
  const Point2 from{robot.x, robot.y};
  const auto scanner = compose(robot, scan.mount);
  // From within the doorway, its posts are not seen.
  constexpr double nearest = 0.8; // m
  const auto far = distance(scanner, gateway.pose);
  if (far < nearest || far > options_.sight ||
      (x.misses > 0 && distance(from, x.last_miss_from) < options_.apart))
    return;
  const auto sight = std::atan2(gateway.pose.y - scanner.y, gateway.pose.x - scanner.x);
  if (difference_of_lines(sight, gateway.pose.heading) > options_.slant)
    return;
  // What hides it: a door that is shut is none the less a door.
  constexpr double hidden = 0.25; // m
  const auto line = gateway.line();
  const std::array<Point2, 3> points{line.a, Point2{gateway.pose.x, gateway.pose.y}, line.b};
  for (auto& p : points)
    if (range_towards(scan, scanner, p) < distance(Point2{scanner.x, scanner.y}, p) - hidden)
      return;
  if (range_towards(scan, scanner, points[1]) < far + hidden)
    return;
  ++x.misses;
  x.last_miss_from = from;
}

void GatewayTracker::summarise(std::int64_t id) {
  auto& evidence = evidence_[id];
  auto& result = gateways_[id];
  if (evidence.views.empty())
    return;
  const auto best = std::ranges::max_element(evidence.views, {}, &View::weight);
  const auto facing = compose(best->robot, best->on_robot).heading;
  // A wall has two faces: views from one side show that side's, so that each side counts the same.
  struct Side {
    double weight = 0;
    double x = 0;
    double y = 0;
    double turned = 0;
    double width = 0;
  };
  std::array<Side, 2> sides;
  for (auto& view : evidence.views) {
    const auto in_map = compose(view.robot, view.on_robot);
    const auto turned = normalised(in_map.heading - facing);
    const bool is_other = std::abs(turned) > half_turn / 2;
    auto& side = sides[is_other ? 1 : 0];
    side.weight += view.weight;
    side.x += view.weight * in_map.x;
    side.y += view.weight * in_map.y;
    side.turned += view.weight * (is_other ? normalised(turned + half_turn) : turned);
    side.width += view.weight * view.width;
  }
  Side mean;
  for (auto& side : sides) {
    if (!(side.weight > 0))
      continue;
    mean.weight += 1;
    mean.x += side.x / side.weight;
    mean.y += side.y / side.weight;
    mean.turned += side.turned / side.weight;
    mean.width += side.width / side.weight;
  }
  result.pose = {mean.x / mean.weight, mean.y / mean.weight,
                 normalised(facing + mean.turned / mean.weight)};
  result.width = mean.width / mean.weight;
  result.keyframe = best->keyframe;
  const auto share = static_cast<double>(evidence.hits) / (evidence.hits + evidence.misses);
  const auto views = evidence.support == true ? 1 : options_.views;
  result.is_doubted = evidence.support == false;
  const auto least = result.is_doubted ? options_.least_share_if_doubted : options_.least_share;
  result.is_confirmed = evidence.hits >= views && share >= least;
}

void GatewayTracker::support(std::int64_t gateway, std::optional<bool> is_gateway) {
  evidence_.at(gateway).support = is_gateway;
  summarise(gateway);
}

void GatewayTracker::remove(std::int64_t keyframe, const PoseOf& pose_of) {
  for (auto& [id, x] : evidence_)
    std::erase_if(x.views, [&](const View& view) { return view.keyframe == keyframe; });
  std::erase_if(evidence_, [](auto& x) { return x.second.views.empty(); });
  std::erase_if(gateways_, [&](auto& x) { return !evidence_.contains(x.first); });
  correct(pose_of);
}

void GatewayTracker::correct(const PoseOf& pose_of) {
  for (auto& [id, x] : evidence_) {
    for (auto& view : x.views)
      view.robot = pose_of(view.keyframe);
    summarise(id);
  }
  merge_those_at_one_place();
}

void GatewayTracker::merge_those_at_one_place() {
  for (auto a = gateways_.begin(); a != gateways_.end(); ++a) {
    for (auto b = std::next(a); b != gateways_.end();) {
      if (!is_same(a->second.pose, b->second.pose)) {
        ++b;
        continue;
      }
      auto& into = evidence_[a->first];
      auto& from = evidence_[b->first];
      into.views.insert(into.views.end(), from.views.begin(), from.views.end());
      std::ranges::sort(into.views, std::ranges::greater{}, &View::weight);
      if (into.views.size() > options_.most_views)
        into.views.resize(options_.most_views);
      into.hits += from.hits;
      into.misses += from.misses;
      evidence_.erase(b->first);
      b = gateways_.erase(b);
      summarise(a->first);
    }
  }
}

} // namespace castor::mapping
