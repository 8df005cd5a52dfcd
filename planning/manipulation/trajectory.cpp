#include "castor/planning/manipulation/trajectory.hpp"

#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/speed_profile.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::manipulation {

namespace {

// Smaller roundings of corners are not worth their grid.
constexpr double least_radius = 1e-3;

/// What the joints permit between two points of a piece.
SpeedLimits limits_between(const ArmModel& arm, const BlendedPath::Piece& piece, double begin,
                           double end, const TimingOptions& options) {
  SpeedLimits result;
  result.length = end - begin;
  result.fastest = 1e12;
  const auto slope_begin = slope(piece, begin);
  const auto slope_end = slope(piece, end);
  const auto moving = moving_joints(arm);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const auto& joint = arm.joints[moving[i]];
    // The slope changes evenly, so that it is largest at one of the ends.
    const double steepest = std::max(std::abs(slope_begin[i]), std::abs(slope_end[i]));
    if (steepest > 0)
      result.fastest =
        std::min(result.fastest, std::pow(options.speed_share * joint.speed / steepest, 2));
    const double most = options.acceleration_share * joint.acceleration;
    const double curvature = 2 * piece.c[i];
    add_acceleration_limit(result, slope_begin[i], curvature, 0, most);
    if (curvature != 0)
      add_acceleration_limit(result, slope_end[i], curvature, result.length, most);
  }
  return result;
}

/// Whether the rounded corner of three waypoints has no contact.
bool is_free_corner(CollisionChecker& checker, const std::vector<Configuration>& waypoints,
                    double radius) {
  const BlendedPath path(waypoints, {0, radius, 0});
  for (const auto& piece : path.pieces()) {
    // Lines have no contact anyway.
    if (std::ranges::all_of(piece.c, [](double x) { return x == 0; }))
      continue;
    // The path is no longer than its parameter.
    const auto steps = std::ceil((piece.end - piece.begin) / checker.step());
    for (int i = 0; i <= static_cast<int>(steps); ++i)
      if (!checker.is_free(path.at(piece.begin + i / steps * (piece.end - piece.begin))))
        return false;
  }
  return true;
}

} // namespace

Trajectory::Trajectory(BlendedPath path, std::vector<Interval> intervals)
  : path_(std::move(path)), intervals_(std::move(intervals)) {
  // nop
}

double Trajectory::duration() const {
  return intervals_.empty() ? 0 : intervals_.back().time + intervals_.back().duration;
}

JointState Trajectory::at(double time) const {
  if (intervals_.empty() || time <= 0 || time >= duration()) {
    JointState result{path_.at(time <= 0 ? 0 : path_.length()), {}, {}};
    result.speeds.assign(result.positions.size(), 0);
    result.accelerations = result.speeds;
    return result;
  }
  const auto interval = std::prev(std::ranges::upper_bound(intervals_, time, {}, &Interval::time));
  const auto& piece = path_.pieces()[interval->piece];
  const double u = (interval->x_end - interval->x_begin) / (2 * (interval->end - interval->begin));
  const double since = time - interval->time;
  const double speed = std::sqrt(interval->x_begin) + u * since;
  const double s = interval->begin + since * (std::sqrt(interval->x_begin) + speed) / 2;
  JointState result{path_.at(s), slope(piece, s), slope(piece, s)};
  for (std::size_t i = 0; i < result.speeds.size(); ++i) {
    result.accelerations[i] = result.speeds[i] * u + 2 * piece.c[i] * speed * speed;
    result.speeds[i] *= speed;
  }
  return result;
}

Trajectory time_parameterise(const ArmModel& arm, const BlendedPath& path,
                             const TimingOptions& options) {
  std::vector<SpeedLimits> limits;
  std::vector<Trajectory::Interval> intervals;
  std::vector<std::size_t> rests;
  for (std::size_t i = 0; i < path.pieces().size(); ++i) {
    const auto& piece = path.pieces()[i];
    if (!path.is_smooth_before(i))
      rests.push_back(intervals.size());
    // Two at least: with rest at both ends, the arm moves between.
    const int count =
      std::max(2, static_cast<int>(std::ceil((piece.end - piece.begin) / options.grid)));
    const double length = (piece.end - piece.begin) / count;
    for (int j = 0; j < count; ++j) {
      Trajectory::Interval interval;
      interval.begin = piece.begin + j * length;
      interval.end = j + 1 == count ? piece.end : interval.begin + length;
      interval.piece = i;
      limits.push_back(limits_between(arm, piece, interval.begin, interval.end, options));
      intervals.push_back(interval);
    }
  }
  if (!intervals.empty()) {
    const auto profile = fastest_profile(limits, rests);
    double time = 0;
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      auto& x = intervals[i];
      x.x_begin = profile[i];
      x.x_end = profile[i + 1];
      x.time = time;
      x.duration = 2 * (x.end - x.begin) / (std::sqrt(x.x_begin) + std::sqrt(x.x_end));
      time += x.duration;
    }
  }
  return {path, std::move(intervals)};
}

Trajectory time_parameterise(const ArmModel& arm, CollisionChecker& checker,
                             const std::vector<Configuration>& waypoints,
                             const TimingOptions& options) {
  std::vector<double> radii(waypoints.size(), 0);
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
    const double lines =
      std::min(distance(waypoints[i - 1], waypoints[i]), distance(waypoints[i], waypoints[i + 1]));
    double radius = std::min(options.blend_radius, lines / 2);
    while (radius >= least_radius &&
           !is_free_corner(checker, {waypoints[i - 1], waypoints[i], waypoints[i + 1]}, radius))
      radius /= 2;
    if (radius >= least_radius)
      radii[i] = radius;
  }
  return time_parameterise(arm, BlendedPath(waypoints, radii), options);
}

} // namespace castor::manipulation
