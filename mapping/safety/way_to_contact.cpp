#include "castor/mapping/safety/way_to_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace castor::mapping {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Circles that are flatter are straight within the range of any laser, 1/m.
constexpr double straight = 1e-6;

double along_line(const Point2& p, double radius) {
  if (std::abs(p.y) >= radius || p.x <= 0)
    return never;
  return p.x - std::sqrt(radius * radius - p.y * p.y);
}

/// To the left. The middle of the disc and the point are seen from the middle of the circle; the
/// law of cosines says how far apart they are when the disc touches.
double along_circle(const Point2& p, double turning_radius, double radius) {
  const double to_point = std::hypot(p.x, p.y - turning_radius);
  if (std::abs(to_point - turning_radius) >= radius || to_point == 0)
    return never;
  const double cosine = (turning_radius * turning_radius + to_point * to_point - radius * radius) /
                        (2 * turning_radius * to_point);
  // The disc is so large, or its circle so small, that it always covers the point.
  if (cosine <= -1)
    return never;
  using std::numbers::pi;
  const double ahead = std::atan2(p.y - turning_radius, p.x) + pi / 2;
  double angle = std::fmod(ahead - std::acos(std::min(1.0, cosine)), 2 * pi);
  if (angle < 0)
    angle += 2 * pi;
  return angle * turning_radius;
}

} // namespace

double way_to_contact(const Point2& p, double curvature, double radius) {
  if (std::hypot(p.x, p.y) <= radius)
    return p.x > 0 ? 0 : never;
  if (std::abs(curvature) < straight)
    return along_line(p, radius);
  // A circle to the right is one to the left in a mirror.
  return along_circle({p.x, curvature > 0 ? p.y : -p.y}, 1 / std::abs(curvature), radius);
}

} // namespace castor::mapping
