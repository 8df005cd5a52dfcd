#include "castor/mapping/building/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace castor::mapping {

namespace {

double distance_to_boundary(const Polygon& x, const Point2& p) {
  double result = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < x.size(); ++i)
    result = std::min(result, distance(Segment{x[i], x[(i + 1) % x.size()]}, p));
  return result;
}

} // namespace

double length(const Segment& x) {
  return distance(x.from, x.to);
}

Point2 point_at(const Segment& x, double share) {
  return {x.from.x + share * (x.to.x - x.from.x), x.from.y + share * (x.to.y - x.from.y)};
}

double nearest_share(const Segment& x, const Point2& p) {
  const double dx = x.to.x - x.from.x;
  const double dy = x.to.y - x.from.y;
  const double square = dx * dx + dy * dy;
  if (!(square > 0))
    return 0;
  return std::clamp(((p.x - x.from.x) * dx + (p.y - x.from.y) * dy) / square, 0.0, 1.0);
}

double distance(const Segment& x, const Point2& p) {
  return distance(point_at(x, nearest_share(x, p)), p);
}

double signed_area(const Polygon& x) {
  double twice = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto& a = x[i];
    const auto& b = x[(i + 1) % x.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

bool contains(const Polygon& x, const Point2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto& a = x[i];
    const auto& b = x[(i + 1) % x.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y))
      inside = !inside;
  }
  return inside;
}

Point2 label_point(const Polygon& x, const std::vector<Polygon>& holes) {
  constexpr int steps = 24;
  auto [left, right] = std::ranges::minmax(x, {}, &Point2::x);
  auto [low, high] = std::ranges::minmax(x, {}, &Point2::y);
  Point2 best = x.front();
  double best_distance = -1;
  for (int i = 1; i < steps; ++i)
    for (int j = 1; j < steps; ++j) {
      const Point2 p{left.x + (right.x - left.x) * i / steps, low.y + (high.y - low.y) * j / steps};
      const bool in_hole =
        std::ranges::any_of(holes, [&](const Polygon& hole) { return contains(hole, p); });
      if (in_hole || !contains(x, p))
        continue;
      double d = distance_to_boundary(x, p);
      for (const auto& hole : holes)
        d = std::min(d, distance_to_boundary(hole, p));
      if (d > best_distance + 1e-9) {
        best = p;
        best_distance = d;
      }
    }
  return best;
}

} // namespace castor::mapping
