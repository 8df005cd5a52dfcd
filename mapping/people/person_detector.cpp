#include "castor/mapping/people/person_detector.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace castor::mapping {

namespace {

/// Middle of a round part of which the scanner sees the front half: of a half circle, the mean lies
/// pi / 4 of the radius before the middle, as seen along the beams.
Point2 middle_of(std::span<const Point2> points, const Point2& scanner) {
  constexpr double thinnest = 0.06; // radius of a leg, metres
  constexpr double thickest = 0.25; // of a body
  Point2 mean;
  for (const auto& x : points) {
    mean.x += x.x / static_cast<double>(points.size());
    mean.y += x.y / static_cast<double>(points.size());
  }
  const double radius = std::clamp(distance(points.front(), points.back()) / 2, thinnest, thickest);
  const double away = std::numbers::pi / 4 * radius / std::max(0.01, distance(scanner, mean));
  return {mean.x + away * (mean.x - scanner.x), mean.y + away * (mean.y - scanner.y)};
}

} // namespace

std::vector<Point2> PersonDetector::detect(const LaserScan& scan, const Pose2& robot,
                                           std::span<const Point2> known) {
  const auto scanner_pose = compose(robot, scan.mount);
  const Point2 scanner{scanner_pose.x, scanner_pose.y};
  std::vector<Point2> ends;
  std::vector<Point2> parts;
  std::vector<Point2> part;
  // Beams that the part consists of.
  std::size_t first = 0;
  std::size_t last = 0;
  const auto is_known = [&](const Point2& place) {
    return std::ranges::any_of(known,
                               [&](auto& x) { return distance(x, place) < options_.person_size; });
  };
  const auto finish_part = [&] {
    if (!part.empty() && distance(part.front(), part.back()) < options_.widest_part) {
      const auto place = middle_of(part, scanner);
      if (stands_alone(scan, first, last) || is_known(place))
        parts.push_back(place);
    }
    part.clear();
  };
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i];
    constexpr double nearest = 0.02; // metres
    if (!(range > nearest))
      continue;
    const double angle = scan.first_angle + static_cast<double>(i) * scan.angle_step;
    const auto end = transform(scanner_pose, {range * std::cos(angle), range * std::sin(angle)});
    ends.push_back(end);
    const bool stands_out = range < options_.range && free_space_.was_free(end);
    // Beams fan out.
    const double gap = std::max(options_.part_gap, 2 * range * scan.angle_step);
    if (!part.empty() && (!stands_out || distance(part.back(), end) > gap))
      finish_part();
    if (stands_out) {
      if (part.empty())
        first = i;
      last = i;
      part.push_back(end);
    }
  }
  finish_part();
  free_space_.add(scanner, ends, known);
  return group(std::move(parts));
}

bool PersonDetector::stands_alone(const LaserScan& scan, std::size_t first,
                                  std::size_t last) const {
  const auto goes_on = [&](std::size_t edge, std::size_t beside) {
    const double gap = std::max(options_.part_gap, 2 * scan.ranges[edge] * scan.angle_step);
    return scan.ranges[beside] > 0 && std::abs(scan.ranges[beside] - scan.ranges[edge]) <= gap;
  };
  return !(first > 0 && goes_on(first, first - 1)) &&
         !(last + 1 < scan.ranges.size() && goes_on(last, last + 1));
}

std::vector<Point2> PersonDetector::group(std::vector<Point2> parts) const {
  // The two nearest become one until all are apart; there are few.
  std::vector<double> weights(parts.size(), 1);
  while (parts.size() > 1) {
    std::size_t a = 0;
    std::size_t b = 1;
    double nearest = distance(parts[0], parts[1]);
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t j = i + 1; j < parts.size(); ++j)
        if (const double x = distance(parts[i], parts[j]); x < nearest) {
          nearest = x;
          a = i;
          b = j;
        }
    if (nearest > options_.person_size)
      break;
    const double weight = weights[a] + weights[b];
    parts[a] = {(parts[a].x * weights[a] + parts[b].x * weights[b]) / weight,
                (parts[a].y * weights[a] + parts[b].y * weights[b]) / weight};
    weights[a] = weight;
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(b));
    weights.erase(weights.begin() + static_cast<std::ptrdiff_t>(b));
  }
  return parts;
}

} // namespace castor::mapping
