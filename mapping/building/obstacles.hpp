#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <optional>
#include <span>
#include <vector>

namespace castor::mapping {

/// A round obstacle that may move, such as a person.
struct Disc {
  Point2 centre;
  double radius = 0;

  friend bool operator==(const Disc&, const Disc&) = default;
};

/// What stands in the way of rays and of round robots in a horizontal plane. Safe for use by
/// several threads at once.
class Obstacles {
public:
  Obstacles() = default;
  Obstacles(const Obstacles&) = delete;
  Obstacles& operator=(const Obstacles&) = delete;
  virtual ~Obstacles() = default;

  /// Distance to the first obstacle on a ray, metres; nothing if there is none within `max_range`.
  /// 0 if the ray begins in an obstacle.
  /// @param direction from the x axis, radians
  virtual std::optional<double> cast(const Point2& origin, double direction,
                                     double max_range) const = 0;

  /// Distance to the nearest obstacle, metres, 0 within one; `limit` if there is none so near.
  virtual double clearance(const Point2& p, double limit) const = 0;
};

/// Distance to the disc on a ray, as for Obstacles.
std::optional<double> cast(const Disc& disc, const Point2& origin, double direction,
                           double max_range);

/// Distance to the nearest of obstacles and discs, as for Obstacles.
double clearance(const Obstacles& fixed, std::span<const Disc> moving, const Point2& p,
                 double limit);

} // namespace castor::mapping
