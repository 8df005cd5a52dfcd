#include "castor/mapping/graph/segments.hpp"

#include <algorithm>

namespace castor::mapping {

namespace {

/// Positive if `p` is left of the way from a to b.
double side(const Line2& line, const Point2& p) {
  return (line.b.x - line.a.x) * (p.y - line.a.y) - (line.b.y - line.a.y) * (p.x - line.a.x);
}

} // namespace

double distance(const Line2& line, const Point2& p) {
  auto dx = line.b.x - line.a.x;
  auto dy = line.b.y - line.a.y;
  auto square = dx * dx + dy * dy;
  if (!(square > 0))
    return distance(line.a, p);
  auto share = std::clamp(((p.x - line.a.x) * dx + (p.y - line.a.y) * dy) / square, 0.0, 1.0);
  return distance(Point2{line.a.x + share * dx, line.a.y + share * dy}, p);
}

bool cross(const Line2& x, const Line2& y) {
  auto from = side(x, y.a);
  auto to = side(x, y.b);
  auto other_from = side(y, x.a);
  auto other_to = side(y, x.b);
  if (from == to || other_from == other_to)
    return false;
  return from * to <= 0 && other_from * other_to <= 0;
}

} // namespace castor::mapping
