#include "castor/mapping/people/person_detector.hpp"

#include "castor/mapping/planar/beams.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

namespace castor::mapping {

namespace {

constexpr double nearest = 0.02; // metres

Point2 mean_of(std::span<const Point2> points) {
  Point2 result;
  for (const auto& x : points) {
    result.x += x.x / static_cast<double>(points.size());
    result.y += x.y / static_cast<double>(points.size());
  }
  return result;
}

/// Middle of a part of which the scanner sees the front. Of a half circle, the mean lies pi / 4 of
/// the radius before the middle, as seen along the beams. What is wider than a leg is a body if its
/// front is round, else two legs side by side.
Point2 middle_of(std::span<const Point2> ends, double width, const Point2& scanner) {
  constexpr double leg = 0.07; // radius, metres
  constexpr double body = 0.25;
  constexpr double widest_leg = 0.2;
  const auto mean = mean_of(ends);
  double radius = leg;
  if (width > widest_leg) {
    const auto edge = (distance(scanner, ends.front()) + distance(scanner, ends.back())) / 2;
    const auto front = std::ranges::min(ends, {}, [&](auto& x) { return distance(scanner, x); });
    constexpr double roundness = 0.25;
    if (edge - distance(scanner, front) > roundness * width)
      radius = std::min(width / 2, body);
  }
  const double away = std::numbers::pi / 4 * radius / std::max(nearest, distance(scanner, mean));
  return {mean.x + away * (mean.x - scanner.x), mean.y + away * (mean.y - scanner.y)};
}

/// Range of the beam beside; of one without a return that of the next, which may be farther than
/// everything. Nothing at the end of the scan.
std::optional<double> range_beside(const LaserScan& scan, std::size_t edge, int side) {
  const auto beams = static_cast<std::ptrdiff_t>(scan.ranges.size());
  auto at = static_cast<std::ptrdiff_t>(edge) + side;
  if (at < 0 || at >= beams)
    return std::nullopt;
  if (const double range = scan.ranges[static_cast<std::size_t>(at)]; range > nearest)
    return range;
  at += side;
  if (at < 0 || at >= beams)
    return std::nullopt;
  const double range = scan.ranges[static_cast<std::size_t>(at)];
  return range > nearest ? range : scan.max_range;
}

bool is_near_any(std::span<const Point2> places, const Point2& x, double reach) {
  return std::ranges::any_of(places, [&](const Point2& y) { return distance(x, y) < reach; });
}

} // namespace

std::vector<BodyPart> PersonDetector::detect(const LaserScan& scan, const Pose2& robot,
                                             std::span<const Point2> known) {
  const auto scanner_pose = compose(robot, scan.mount);
  const Point2 scanner{scanner_pose.x, scanner_pose.y};
  std::vector<BodyPart> result;
  std::vector<Point2> standing;
  std::vector<Point2> moving;
  const auto all = clusters(scan, scanner_pose);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& x = all[i];
    const bool is_apart = is_separate(scan, x);
    for (const auto& end : x.ends)
      (is_apart && is_near_any(known, end, options_.moving_reach) ? moving : standing)
        .push_back(end);
    const double width = distance(x.ends.front(), x.ends.back());
    if (width > options_.widest_part || scan.ranges[x.first] > options_.range)
      continue;
    const BodyPart part{middle_of(x.ends, width, scanner), width, x.is_new, stands_out(scan, x),
                        free_space_.is_settled(x.ends[x.ends.size() / 2])};
    const bool may_begin =
      part.is_new || (!part.is_settled && scan.ranges[x.first] < options_.near_range);
    const bool is_alone = may_begin && part.stands_out;
    // Walls at a small angle are single beams.
    const bool is_hidden_part = part.is_new && !is_joined(all, i) && width > options_.least_part;
    if (is_alone || ((is_hidden_part || part.stands_out) &&
                     is_near_any(known, part.place, options_.known_reach)))
      result.push_back(part);
  }
  free_space_.add(scanner, standing, moving);
  return result;
}

std::vector<PersonDetector::Cluster> PersonDetector::clusters(const LaserScan& scan,
                                                              const Pose2& scanner) const {
  std::vector<Cluster> result;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i];
    if (!(range > nearest))
      continue;
    const auto end = transform(scanner, end_of_beam(scan, i));
    const bool is_new = range < options_.range && free_space_.was_free(end);
    // Beams fan out.
    const double gap = std::max(options_.part_gap, 2 * range * scan.angle_step);
    if (result.empty() || result.back().is_new != is_new ||
        distance(result.back().ends.back(), end) > gap)
      result.push_back({i, i, is_new, {}});
    result.back().last = i;
    result.back().ends.push_back(end);
  }
  return result;
}

bool PersonDetector::stands_out(const LaserScan& scan, const Cluster& x) const {
  return passes(scan, x.first, -1) && passes(scan, x.last, 1);
}

bool PersonDetector::passes(const LaserScan& scan, std::size_t edge, int side) const {
  const auto range = range_beside(scan, edge, side);
  return range && *range > scan.ranges[edge] + options_.passing;
}

bool PersonDetector::is_separate(const LaserScan& scan, const Cluster& x) const {
  const auto is_hidden = [&](std::size_t edge, int side) {
    const auto range = range_beside(scan, edge, side);
    return range && *range < scan.ranges[edge] - options_.passing;
  };
  const bool left = passes(scan, x.first, -1);
  const bool right = passes(scan, x.last, 1);
  return (left && (right || is_hidden(x.last, 1))) || (right && is_hidden(x.first, -1));
}

bool PersonDetector::is_joined(std::span<const Cluster> all, std::size_t i) const {
  const auto joins = [&](const Cluster& before, const Cluster& after) {
    return before.last + 1 == after.first && !(before.is_new && after.is_new) &&
           distance(before.ends.back(), after.ends.front()) < options_.joint;
  };
  return (i > 0 && joins(all[i - 1], all[i])) || (i + 1 < all.size() && joins(all[i], all[i + 1]));
}

} // namespace castor::mapping
