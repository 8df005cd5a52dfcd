#include "castor/planning/manipulation/speed_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace castor::manipulation {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Range {
  double low = -infinite;
  double high = infinite;
};

/// Accelerations that are permitted at x, if the square of the speed afterwards is to be in [0,
/// next].
Range accelerations(const SpeedLimits& limits, double x, double next) {
  Range result{-x / (2 * limits.length), (next - x) / (2 * limits.length)};
  for (const auto& [a, b, c] : limits.lines) {
    const double rest = c - b * x;
    if (a > 0)
      result.high = std::min(result.high, rest / a);
    else if (a < 0)
      result.low = std::max(result.low, rest / a);
    else if (rest < 0)
      return {infinite, -infinite};
  }
  return result;
}

/// How much the lower bound exceeds the upper one: above 0, nothing is permitted at x.
double excess(const SpeedLimits& limits, double x, double next) {
  const auto [low, high] = accelerations(limits, x, next);
  return low - high;
}

/// The largest x from which a speed of at most `next` can be reached. All lines permit x = 0 with
/// u = 0, and what they permit is convex, so that it is an interval from 0 on.
double controllable(const SpeedLimits& limits, double next) {
  double high = limits.fastest;
  if (excess(limits, high, next) <= 0)
    return high;
  double low = 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (excess(limits, middle, next) <= 0 ? low : high) = middle;
  }
  return low;
}

} // namespace

void add_acceleration_limit(SpeedLimits& limits, double slope, double curvature, double behind,
                            double acceleration) {
  // The square of the speed there is x + 2 u behind.
  const double a = slope + 2 * curvature * behind;
  limits.lines.push_back({a, curvature, acceleration});
  limits.lines.push_back({-a, -curvature, acceleration});
}

std::vector<double> fastest_profile(const std::vector<SpeedLimits>& intervals,
                                    const std::vector<std::size_t>& rests) {
  std::vector<double> result(intervals.size() + 1, infinite);
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    result[i] = std::min(result[i], intervals[i].fastest);
    result[i + 1] = intervals[i].fastest;
  }
  for (auto rest : rests)
    result[rest] = 0;
  result.front() = result.back() = 0;
  for (std::size_t i = intervals.size(); i-- > 0;)
    result[i] = std::min(result[i], controllable(intervals[i], result[i + 1]));
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const double u = accelerations(intervals[i], result[i], result[i + 1]).high;
    result[i + 1] = std::clamp(result[i] + 2 * u * intervals[i].length, 0.0, result[i + 1]);
  }
  return result;
}

} // namespace castor::manipulation
