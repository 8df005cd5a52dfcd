#include "castor/mapping/building/obstacles.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

std::optional<double> cast(const Disc& disc, const Point2& origin, double direction,
                           double max_range) {
  const double x = disc.centre.x - origin.x;
  const double y = disc.centre.y - origin.y;
  const double away = x * x + y * y - disc.radius * disc.radius;
  if (away <= 0)
    return 0;
  // Along the ray to the point nearest to the centre, and from there back to the circle.
  const double along = x * std::cos(direction) + y * std::sin(direction);
  const double half_chord_squared = along * along - away;
  if (along < 0 || half_chord_squared < 0)
    return std::nullopt;
  const double hit = along - std::sqrt(half_chord_squared);
  if (hit > max_range)
    return std::nullopt;
  return hit;
}

double clearance(const Obstacles& fixed, std::span<const Disc> moving, const Point2& p,
                 double limit) {
  double result = fixed.clearance(p, limit);
  for (const auto& disc : moving)
    result = std::min(result, std::max(0.0, distance(disc.centre, p) - disc.radius));
  return result;
}

} // namespace castor::mapping
