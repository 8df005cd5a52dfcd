#include "castor/mapping/slam/surface_points.hpp"

#include "castor/mapping/planar/beams.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

namespace castor::mapping {

namespace {

struct BeamEnd {
  Point2 position;
  double range = 0;
};

// Sums of a line fit.
struct Moments {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(const Point2& p) {
    n += 1;
    x += p.x;
    y += p.y;
    xx += p.x * p.x;
    xy += p.x * p.y;
    yy += p.y * p.y;
  }
};

// Normal of the line through the points, towards `from`; zero if they are on no line.
Point2 normal_of(const Moments& m, const Point2& from, const SurfaceOptions& options) {
  if (m.n < 3)
    return {};
  auto xx = m.xx / m.n - (m.x / m.n) * (m.x / m.n);
  auto xy = m.xy / m.n - (m.x / m.n) * (m.y / m.n);
  auto yy = m.yy / m.n - (m.y / m.n) * (m.y / m.n);
  auto root = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
  auto large = (xx + yy) / 2 + root;
  auto small = (xx + yy) / 2 - root;
  if (small > options.line_deviation * options.line_deviation || small > 0.25 * large)
    return {};
  auto along = std::atan2(2 * xy, xx - yy) / 2;
  Point2 normal{-std::sin(along), std::cos(along)};
  if (normal.x * (from.x - m.x / m.n) + normal.y * (from.y - m.y / m.n) < 0)
    normal = {-normal.x, -normal.y};
  return normal;
}

} // namespace

SurfacePoints surface_points(const LaserScan& scan, const SurfaceOptions& options) {
  std::vector<BeamEnd> ends(scan.ranges.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    double range = scan.ranges[i];
    if (!(range >= options.min_range && range <= options.max_range))
      continue;
    ends[i] = {transform(scan.mount, end_of_beam(scan, i)), range};
  }
  SurfacePoints result;
  Point2 laser{scan.mount.x, scan.mount.y};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto& end = ends[i];
    if (end.range == 0)
      continue;
    auto gap = std::max(options.same_surface, options.same_surface_share * end.range);
    // At least the two neighbours on each side, if they are of the same surface.
    auto radius = std::max(options.fit_radius, 2.5 * end.range * scan.angle_step);
    Moments moments;
    moments.add({0, 0});
    auto add_side = [&](auto step) {
      const auto* last = &end;
      for (auto j = step(i); j < ends.size(); j = step(j)) {
        const auto& other = ends[j];
        if (other.range == 0 || distance(other.position, last->position) > gap ||
            distance(other.position, end.position) > radius)
          break;
        moments.add({other.position.x - end.position.x, other.position.y - end.position.y});
        last = &other;
      }
    };
    add_side([](std::size_t j) { return j + 1; });
    // Below 0 is beyond the end as well.
    add_side([](std::size_t j) { return j - 1; });
    Point2 from{laser.x - end.position.x, laser.y - end.position.y};
    result.push_back({end.position, normal_of(moments, from, options)});
  }
  return result;
}

SurfacePoints transform(const Pose2& body, const SurfacePoints& points) {
  auto c = std::cos(body.heading);
  auto s = std::sin(body.heading);
  auto rotate = [&](const Point2& x) { return Point2{c * x.x - s * x.y, s * x.x + c * x.y}; };
  SurfacePoints result;
  result.reserve(points.size());
  for (const auto& x : points) {
    auto p = rotate(x.position);
    result.push_back({{p.x + body.x, p.y + body.y}, rotate(x.normal)});
  }
  return result;
}

SurfacePoints thinned(const SurfacePoints& points, double spacing) {
  SurfacePoints result;
  std::unordered_set<std::int64_t> taken;
  for (const auto& x : points) {
    auto column = std::llround(x.position.x / spacing);
    auto row = std::llround(x.position.y / spacing);
    if (taken.insert((column << 32) ^ (row & 0xffffffff)).second)
      result.push_back(x);
  }
  return result;
}

} // namespace castor::mapping
