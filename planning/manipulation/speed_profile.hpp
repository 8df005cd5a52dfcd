#pragma once

#include "castor/planning/manipulation/arm_model.hpp"

#include <vector>

/// Speeds along a path, for trajectory.hpp.
namespace castor::manipulation {

/// Between two points on a path, which are `length` apart: with x the square of the speed along the
/// path at the first, and u the acceleration along it, a u + b x <= c for each of these; and the
/// square of the speed at both ends is at most `fastest`.
struct SpeedLimits {
  struct Line {
    double a = 0;
    double b = 0;
    double c = 0;
  };

  double length = 0;
  double fastest = 0;
  std::vector<Line> lines;
};

/// Limits of an interval by those of a joint at one of its ends.
/// @param slope,curvature first and second derivative of the joint's position by the path's length
/// @param behind how far that end is from the interval's beginning
void add_acceleration_limit(SpeedLimits& limits, double slope, double curvature, double behind,
                            double acceleration);

/// The largest squares of speeds at the points that the intervals lie between, from rest to rest,
/// and with rest at the points of these indices.
std::vector<double> fastest_profile(const std::vector<SpeedLimits>& intervals,
                                    const std::vector<std::size_t>& rests);

} // namespace castor::manipulation
