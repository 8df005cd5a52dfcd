#include "castor/mapping/planar/poses.hpp"

#include <cmath>
#include <numbers>

namespace castor::mapping {

double normalised(double radians) {
  using std::numbers::pi;
  auto result = std::remainder(radians, 2 * pi);
  return result <= -pi ? result + 2 * pi : result;
}

Point2 transform(const Pose2& body, const Point2& point) {
  auto c = std::cos(body.heading);
  auto s = std::sin(body.heading);
  return {body.x + c * point.x - s * point.y, body.y + s * point.x + c * point.y};
}

Pose2 compose(const Pose2& body, const Pose2& thing) {
  auto [x, y] = transform(body, {thing.x, thing.y});
  return {x, y, normalised(body.heading + thing.heading)};
}

Pose2 inverse(const Pose2& body) {
  auto [x, y] = transform({0, 0, -body.heading}, {-body.x, -body.y});
  return {x, y, normalised(-body.heading)};
}

Pose2 between(const Pose2& from, const Pose2& to) {
  return compose(inverse(from), to);
}

double distance(const Point2& a, const Point2& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

double distance(const Pose2& a, const Pose2& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

Pose2 interpolate(const Pose2& from, const Pose2& to, double share) {
  return {std::lerp(from.x, to.x, share), std::lerp(from.y, to.y, share),
          normalised(from.heading + share * normalised(to.heading - from.heading))};
}

Pose2 moved(const Pose2& body, const Twist2& velocity, double seconds) {
  auto way = velocity.forward * seconds;
  auto angle = velocity.turn * seconds;
  // sin(a) / a and (1 - cos(a)) / a; the arc is straight to double precision below this angle.
  constexpr double straight = 1e-8;
  auto along = std::abs(angle) < straight ? 1 : std::sin(angle) / angle;
  auto aside = std::abs(angle) < straight ? angle / 2 : (1 - std::cos(angle)) / angle;
  return compose(body, {way * along, way * aside, angle});
}

Pose2 best_alignment(const std::vector<std::pair<Pose2, Pose2>>& pairs) {
  const auto n = static_cast<double>(pairs.size());
  Point2 middle;
  Point2 other_middle;
  for (const auto& [a, b] : pairs) {
    middle.x += a.x / n;
    middle.y += a.y / n;
    other_middle.x += b.x / n;
    other_middle.y += b.y / n;
  }
  double along = 0;
  double across = 0;
  for (const auto& [a, b] : pairs) {
    const Point2 from{a.x - middle.x, a.y - middle.y};
    const Point2 to{b.x - other_middle.x, b.y - other_middle.y};
    along += from.x * to.x + from.y * to.y;
    across += from.x * to.y - from.y * to.x;
  }
  const auto turn = std::atan2(across, along);
  const auto turned = transform(Pose2{0, 0, turn}, middle);
  return {other_middle.x - turned.x, other_middle.y - turned.y, turn};
}

} // namespace castor::mapping
