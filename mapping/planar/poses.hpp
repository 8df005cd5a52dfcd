#pragma once

#include "castor/mapping/planar/types.hpp"

#include <utility>
#include <vector>

namespace castor::mapping {

/// A point of the floor.
struct Point2 {
  double x = 0;
  double y = 0;

  friend bool operator==(const Point2&, const Point2&) = default;
};

/// The same angle within (-pi, pi].
double normalised(double radians);

/// Pose of a thing in the frame of `body`, if `thing` is its pose on that body.
Pose2 compose(const Pose2& body, const Pose2& thing);

/// Pose of the frame on the body, if `body` is the body's pose in that frame.
Pose2 inverse(const Pose2& body);

/// Pose of `to` as seen from `from`: compose(from, between(from, to)) is `to`.
Pose2 between(const Pose2& from, const Pose2& to);

/// What is at `point` of a body with that pose: the same point in the pose's frame.
Point2 transform(const Pose2& body, const Point2& point);

/// Metres.
double distance(const Point2& a, const Point2& b);
double distance(const Pose2& a, const Pose2& b);

/// A pose between two, on the shorter way round: `from` at 0, `to` at 1.
Pose2 interpolate(const Pose2& from, const Pose2& to, double share);

/// The pose after `seconds` at a constant velocity, along an arc.
Pose2 moved(const Pose2& body, const Twist2& velocity, double seconds);

/// The motion of the plane after which the first of each pair are nearest to the second, by the
/// squares of distances (Horn 1987); headings do not count. compose() applies it. No motion without
/// pairs.
Pose2 best_alignment(const std::vector<std::pair<Pose2, Pose2>>& pairs);

} // namespace castor::mapping
