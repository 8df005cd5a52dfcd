#include "castor/mapping/safety/way_to_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// What is near already and comes no nearer may come near again: by that much, metres.
constexpr double again = 1e-3;

Point2 minus(const Point2& a, const Point2& b) {
  return {a.x - b.x, a.y - b.y};
}

double dot(const Point2& a, const Point2& b) {
  return a.x * b.x + a.y * b.y;
}

Point2 mirrored(const Point2& p) {
  return {p.x, -p.y};
}

/// The same outline in a mirror, anticlockwise again.
Polygon mirrored(const Polygon& x) {
  Polygon result;
  for (auto i = x.rbegin(); i != x.rend(); ++i)
    result.push_back(mirrored(*i));
  return result;
}

Segment side_of(const Polygon& x, std::size_t i) {
  return {x[i], x[(i + 1) % x.size()]};
}

Point2 nearest_of(const Polygon& x, const Point2& p) {
  Point2 result;
  double least = never;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto side = side_of(x, i);
    const auto at = point_at(side, nearest_share(side, p));
    if (const double far = distance(at, p); far < least) {
      least = far;
      result = at;
    }
  }
  return result;
}

/// A side, so far outside.
Segment outside(const Segment& side, double gap) {
  const double whole = length(side);
  const auto along = minus(side.to, side.from);
  const Point2 by{gap * along.y / whole, -gap * along.x / whole};
  return {{side.from.x + by.x, side.from.y + by.y}, {side.to.x + by.x, side.to.y + by.y}};
}

/// Of the numbers x with a x^2 + 2 b x + c = 0, calls f with each.
template <class F>
void solve(double a, double b, double c, F f) {
  const double root = b * b - a * c;
  if (a == 0 || root < 0)
    return;
  f((-b - std::sqrt(root)) / a);
  f((-b + std::sqrt(root)) / a);
}

/// How a point moves, as seen from what moves along a line towards x.
struct AlongLine {
  Point2 velocity(const Point2&) const { return {-1, 0}; }

  double to(const Segment& line, const Point2& p) const {
    const auto along = minus(line.to, line.from);
    if (along.y == 0)
      return never;
    const double share = (p.y - line.from.y) / along.y;
    const double way = p.x - (line.from.x + share * along.x);
    return share < 0 || share > 1 || way < 0 ? never : way;
  }

  double to(const Point2& middle, double radius, const Point2& p) const {
    const double aside = p.y - middle.y;
    if (std::abs(aside) > radius)
      return never;
    const double way = p.x - middle.x - std::sqrt(radius * radius - aside * aside);
    return way < 0 ? never : way;
  }

  bool may_touch(const Polygon& x, double gap, const Point2& p) const {
    return std::ranges::any_of(x, [&](auto& q) { return q.y >= p.y - gap; }) &&
           std::ranges::any_of(x, [&](auto& q) { return q.y <= p.y + gap; });
  }
};

/// As seen from what moves along a circle to the left: it turns to the right about the middle of
/// the circle. Ways are angles.
struct AlongCircle {
  Point2 centre;

  Point2 velocity(const Point2& p) const {
    const auto arm = minus(p, centre);
    return {arm.y, -arm.x};
  }

  /// To where the point is at `q`.
  double angle(const Point2& p, const Point2& q) const {
    using std::numbers::pi;
    const auto from = minus(p, centre);
    const auto to = minus(q, centre);
    const double result = std::atan2(from.y, from.x) - std::atan2(to.y, to.x);
    return result < 0 ? result + 2 * pi : result;
  }

  double to(const Segment& line, const Point2& p) const {
    const auto along = minus(line.to, line.from);
    const auto from = minus(line.from, centre);
    const auto arm = minus(p, centre);
    double result = never;
    solve(dot(along, along), dot(from, along), dot(from, from) - dot(arm, arm), [&](double share) {
      if (share >= 0 && share <= 1)
        result = std::min(result, angle(p, point_at(line, share)));
    });
    return result;
  }

  double to(const Point2& middle, double radius, const Point2& p) const {
    const auto arm = minus(p, centre);
    const auto to_middle = minus(middle, centre);
    const double turning = std::hypot(arm.x, arm.y);
    const double far = std::hypot(to_middle.x, to_middle.y);
    if (far == 0 || turning == 0 || std::abs(turning - radius) > far || turning + radius < far)
      return never;
    const double cosine = (turning * turning + far * far - radius * radius) / (2 * turning * far);
    const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double ahead = std::atan2(to_middle.y, to_middle.x);
    double result = never;
    for (const double bearing : {ahead - half, ahead + half})
      result = std::min(result, angle(p, {centre.x + turning * std::cos(bearing),
                                          centre.y + turning * std::sin(bearing)}));
    return result;
  }

  bool may_touch(const Polygon& x, double gap, const Point2& p) const {
    const double turning = distance(p, centre);
    double nearest = contains(x, centre) ? 0 : never;
    double farthest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      nearest = std::min(nearest, distance(side_of(x, i), centre));
      farthest = std::max(farthest, distance(x[i], centre));
    }
    return turning >= nearest - gap && turning <= farthest + gap;
  }
};

/// \pre the point is farther than the gap
template <class Motion>
double first_contact(const Motion& motion, const Point2& p, const Polygon& outline, double gap) {
  double result = never;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (const auto side = side_of(outline, i); length(side) > 0)
      result = std::min(result, motion.to(outside(side, gap), p));
    result = std::min(result, motion.to(outline[i], gap, p));
  }
  return result;
}

template <class Motion>
double contact(const Motion& motion, const Point2& p, const Polygon& outline, double gap) {
  if (!motion.may_touch(outline, gap, p))
    return never;
  const bool is_inside = contains(outline, p);
  const auto nearest = nearest_of(outline, p);
  const double far = is_inside ? 0 : distance(nearest, p);
  if (far > gap)
    return first_contact(motion, p, outline, gap);
  const auto outwards = is_inside ? minus(nearest, p) : minus(p, nearest);
  if (dot(motion.velocity(p), outwards) < 0)
    return 0;
  return far <= again ? never : first_contact(motion, p, outline, far - again);
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

double way_to_contact(const Point2& p, double curvature, const Polygon& outline, double gap) {
  if (std::abs(curvature) < straight)
    return contact(AlongLine{}, p, outline, gap);
  const AlongCircle motion{{0, 1 / std::abs(curvature)}};
  // A circle to the right is one to the left in a mirror.
  const double angle = curvature > 0 ? contact(motion, p, outline, gap)
                                     : contact(motion, mirrored(p), mirrored(outline), gap);
  return angle / std::abs(curvature);
}

double turn_to_contact(const Point2& p, bool is_left, const Polygon& outline, double gap) {
  const AlongCircle motion{{0, 0}};
  return is_left ? contact(motion, p, outline, gap)
                 : contact(motion, mirrored(p), mirrored(outline), gap);
}

} // namespace castor::mapping
