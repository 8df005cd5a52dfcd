#pragma once

#include "castor/mapping/building/polygon.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace castor::mapping {

/// Outline of a robot that is no disc, in the robot's frame: its middle, about which it turns, is
/// the origin, and it faces x.
class Footprint {
public:
  /// @param outline metres
  /// \throws std::invalid_argument if that is no polygon around the middle
  explicit Footprint(Polygon outline);

  const Polygon& outline() const { return outline_; }

  /// Of the smallest disc around the middle that holds it, and of the greatest in it; metres.
  double outer_radius() const { return outer_radius_; }
  double inner_radius() const { return inner_radius_; }

  /// Distance of a point of the robot's frame from the footprint, metres; 0 in it.
  double distance_from(const Point2& on_robot) const;

  /// Least clearance of its outline where the robot is, metres, to about a millimetre where that is
  /// small.
  /// @param clearance_at of a place, in the frame of the pose; it changes by at most the way
  double clearance(const Pose2& robot,
                   const std::function<double(const Point2&)>& clearance_at) const;

private:
  Polygon outline_;
  double outer_radius_ = 0;
  double inner_radius_ = 0;
};

/// A footprint as an option has it: the corners in order, X Y, X Y, ..., metres.
/// @param option whose value it is
/// \throws std::invalid_argument naming the option, and what to write
Footprint parse_footprint(std::string_view text, const std::string& option);

} // namespace castor::mapping
