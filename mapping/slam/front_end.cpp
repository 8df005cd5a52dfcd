#include "castor/mapping/slam/front_end.hpp"

#include "castor/mapping/slam/icp_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace castor::mapping {

namespace {

double squared(double x) {
  return x * x;
}

std::unique_ptr<const PointMatcher> matcher_of(const FrontEndOptions& options) {
  if (options.method == MatchingMethod::icp)
    return std::make_unique<IcpMatcher>(options.matcher);
  return std::make_unique<ScanMatcher>(options.matcher);
}

} // namespace

FrontEnd::FrontEnd(const FrontEndOptions& options)
  : options_(options), matcher_(matcher_of(options)), map_(options.map) {}

void FrontEnd::resume(const std::vector<Keyframe>& newest) {
  map_.clear();
  newest_.reset();
  for (const auto& x : newest)
    place(x, surface_points(x.scan, options_.surface));
  if (newest.empty())
    return;
  time_ = newest.back().time;
  odometry_ = newest.back().odometry;
  pose_ = newest.back().local_pose;
  has_resumed_ = true;
}

FrontEnd::Motion FrontEnd::motion_to(std::int64_t time, const Pose2& odometry) const {
  Motion result;
  result.step = between(odometry_, odometry);
  auto seconds = std::max(static_cast<double>(time - time_) / 1e6, 1e-3);
  auto way = std::hypot(result.step.x, result.step.y);
  auto turn = std::abs(result.step.heading);
  // A scan may come late: the first half second is not counted.
  if (way > options_.most_speed * std::max(seconds, 0.5) ||
      turn > options_.most_turn * std::max(seconds, 0.5)) {
    result.reason = "odometry has jumped";
    result.is_uncertain = true;
    result.step = {};
    way = 0.5;
    turn = 0.5;
  } else if (has_resumed_ || seconds > options_.gap) {
    result.reason = "scans are missing";
    result.is_uncertain = way > 0.02 || turn > 0.02;
  }
  if (last_duration_ > 0 && !result.is_uncertain && seconds < options_.gap) {
    auto share = std::min(1e6 * seconds / static_cast<double>(last_duration_), 2.);
    result.as_before =
      Pose2{share * last_step_.x, share * last_step_.y, normalised(share * last_step_.heading)};
  }
  result.prior.translation = options_.odometry_rest + options_.odometry_translation * way;
  result.prior.heading =
    options_.odometry_rest_heading + options_.odometry_turn * turn + options_.odometry_drift * way;
  return result;
}

ScanMatch FrontEnd::match_near(const SurfacePoints& scan, const Motion& motion) const {
  auto by_odometry = compose(pose_, motion.step);
  if (!motion.as_before)
    return matcher_->match(map_.points(), scan, by_odometry, motion.prior);
  auto late = between(motion.step, *motion.as_before);
  auto late_by = std::hypot(late.x, late.y);
  if (late_by < options_.late_odometry && std::abs(late.heading) < options_.late_odometry_heading)
    return matcher_->match(map_.points(), scan, by_odometry, motion.prior);
  auto prior = motion.prior;
  prior.translation += late_by;
  prior.heading += std::abs(late.heading);
  auto a = matcher_->match(map_.points(), scan, by_odometry, prior);
  auto b = matcher_->match(map_.points(), scan, compose(pose_, *motion.as_before), prior);
  return b.matched > a.matched + options_.search_gain ? b : a;
}

std::optional<FrontEnd::Aligned>
FrontEnd::without_narrow(const LaserScan& scan, const ScanMatch& all, const Motion& motion) const {
  const auto wheels = compose(pose_, motion.step);
  const double most = options_.believed_deviations * motion.prior.translation;
  const Point2 off{all.pose.x - wheels.x, all.pose.y - wheels.y};
  const bool is_far = all.matched > 0 && std::hypot(off.x, off.y) > most;
  if (!is_far && all.matched >= options_.sure_matched)
    return std::nullopt;
  Aligned result;
  result.points = surface_points(without_narrow_things(scan, options_.narrow), options_.surface);
  result.match = match_near(thinned(result.points, options_.spacing), motion);
  const Point2 wide_off{result.match.pose.x - wheels.x, result.match.pose.y - wheels.y};
  const bool agrees_with_wheels = std::hypot(wide_off.x, wide_off.y) <= most;
  // It had followed somebody before, by less than is noticed.
  const bool is_drawn_back = is_far && wide_off.x * off.x + wide_off.y * off.y < 0 &&
                             result.match.matched > all.matched + options_.search_gain;
  if (result.match.matched < options_.least_matched || !(agrees_with_wheels || is_drawn_back))
    return std::nullopt;
  return result;
}

void FrontEnd::keep_to_wheels(ScanMatch& match, const Motion& motion) const {
  if (match.matched <= 0 || match.observability >= options_.few_points)
    return;
  auto& covariance = match.covariance;
  const double direction = 0.5 * std::atan2(2 * covariance.xy, covariance.xx - covariance.yy);
  const Point2 weak{std::cos(direction), std::sin(direction)};
  const auto off = [&](const Pose2& step) {
    const auto from = compose(pose_, step);
    return (match.pose.x - from.x) * weak.x + (match.pose.y - from.y) * weak.y;
  };
  const double deviation = motion.prior.translation;
  const double off_wheels = off(motion.step);
  const double most = options_.most_deviations * deviation;
  // If odometry is late, the robot goes on as before.
  if (std::abs(off_wheels) <= most || (motion.as_before && std::abs(off(*motion.as_before)) <= most))
    return;
  match.pose.x -= off_wheels * weak.x;
  match.pose.y -= off_wheels * weak.y;
  covariance.xx += squared(deviation * weak.x);
  covariance.yy += squared(deviation * weak.y);
  covariance.xy += squared(deviation) * weak.x * weak.y;
}

FrontEnd::Found FrontEnd::find(const LaserScan& scan, const SurfacePoints& points,
                               const Motion& motion) const {
  auto standing = points;
  Found result;
  if (!motion.is_uncertain) {
    result.match = match_near(thinned(points, options_.spacing), motion);
    standing = standing_of(points, result.match.pose);
    if (standing.size() < points.size())
      result.match = match_near(thinned(standing, options_.spacing), motion);
    if (auto wide = without_narrow(scan, result.match, motion)) {
      result.match = wide->match;
      standing = std::move(wide->points);
    }
    keep_to_wheels(result.match, motion);
    result.fits = result.match.matched >= options_.least_matched;
    if (result.match.matched >= options_.sure_matched)
      return result;
  }
  // The window covers three deviations of the prediction, and what a robot moves if odometry is
  // late.
  SearchWindow window{std::clamp(3 * motion.prior.translation, 0.4, 3.),
                      std::clamp(3 * motion.prior.heading, 0.3, std::numbers::pi / 2)};
  CorrelativeMatcher coarse{thinned(map_.points().points(), 0.03)};
  auto best =
    coarse.match(thinned(standing, 0.1), compose(pose_, motion.step), window, options_.least_score);
  if (!best)
    return result;
  auto match = matcher_->match(map_.points(), thinned(standing, options_.spacing), best->pose, {});
  // Closest points may move the scan on and on, where nothing tells how far along a wall it is.
  const auto off = between(compose(pose_, motion.step), match.pose);
  const bool is_in_window = std::hypot(off.x, off.y) <= std::numbers::sqrt2 * window.translation &&
                            std::abs(off.heading) <= window.heading + 0.05;
  if (is_in_window && match.matched >= options_.least_matched &&
      match.matched > result.match.matched + options_.search_gain) {
    result.match = match;
    result.fits = true;
  }
  return result;
}

SurfacePoints FrontEnd::standing_of(const SurfacePoints& points, const Pose2& pose) const {
  auto result = map_.standing(points, pose);
  const auto all = static_cast<double>(points.size());
  return static_cast<double>(result.size()) < (1 - options_.most_moved) * all ? points : result;
}

bool FrontEnd::is_far_from_keyframe(const Pose2& pose) const {
  auto way = between(newest_->local_pose, pose);
  return std::hypot(way.x, way.y) >= options_.keyframe_distance ||
         std::abs(way.heading) >= options_.keyframe_turn;
}

FrontEndStep FrontEnd::add(const LaserScan& scan, const Pose2& odometry) {
  auto points = surface_points(scan, options_.surface);
  FrontEndStep result;
  result.time = scan.time;
  if (!newest_) {
    // Its own frame begins as the odometry frame.
    result.local_pose = odometry;
    make_keyframe(result, scan, odometry, points);
  } else {
    auto motion = motion_to(scan.time, odometry);
    auto found = find(scan, points, motion);
    result.matched = found.match.matched;
    if (found.fits) {
      result.local_pose = found.match.pose;
      result.covariance = found.match.covariance;
    } else {
      result.local_pose = compose(pose_, motion.step);
      result.state = LocalisationState::dead_reckoning;
      result.reason = motion.reason.empty() ? "the scan does not fit to the newest keyframes"
                                            : motion.reason + ", and the scan does not fit";
      result.covariance.xx = result.covariance.yy = squared(motion.prior.translation);
      result.covariance.heading = squared(motion.prior.heading);
    }
    if (is_far_from_keyframe(result.local_pose))
      make_keyframe(result, scan, odometry, points);
    else if (found.fits)
      map_.look(scan, result.local_pose);
  }
  // Steps in a very short time say nothing of the speed.
  auto is_known = result.state == LocalisationState::tracking && scan.time - time_ > 10000;
  last_step_ = is_known ? between(pose_, result.local_pose) : Pose2{};
  last_duration_ = is_known && newest_ ? scan.time - time_ : 0;
  has_resumed_ = false;
  time_ = scan.time;
  odometry_ = odometry;
  pose_ = result.local_pose;
  result.keyframe = newest_->number;
  result.on_keyframe = between(newest_->local_pose, pose_);
  return result;
}

void FrontEnd::make_keyframe(FrontEndStep& step, const LaserScan& scan, const Pose2& odometry,
                             const SurfacePoints& points) {
  Keyframe keyframe;
  keyframe.time = scan.time;
  keyframe.odometry = odometry;
  keyframe.local_pose = step.local_pose;
  keyframe.scan = scan;
  if (newest_) {
    keyframe.number = newest_->number + 1;
    step.constraint = constraint_to(step);
  }
  place(keyframe, points);
  step.new_keyframe = std::move(keyframe);
}

Constraint FrontEnd::constraint_to(const FrontEndStep& step) const {
  const auto& before = *newest_;
  Constraint result;
  result.from = before.number;
  result.to = before.number + 1;
  result.pose = between(before.local_pose, step.local_pose);
  auto way = std::hypot(result.pose.x, result.pose.y);
  auto turn = std::abs(result.pose.heading);
  double xx = 0;
  double heading = 0;
  if (step.state == LocalisationState::tracking) {
    xx = squared(options_.motion_deviation + 0.01 * way);
    heading = squared(options_.motion_deviation_heading + 0.01 * turn);
    // A wall that is seen far away is no help along it.
    xx = std::max(xx, std::min({step.covariance.xx, step.covariance.yy, 0.01}));
    // Where much is new, what is known decides with less certainty.
    auto doubt = std::max(1., options_.sure_matched / step.matched);
    xx *= squared(doubt);
    heading *= squared(doubt);
  } else {
    result.kind = ConstraintKind::wheels;
    xx = squared(0.02 + 2 * options_.odometry_translation * way);
    heading = squared(0.02 + 2 * options_.odometry_turn * turn + options_.odometry_drift * way);
  }
  result.covariance.xx = result.covariance.yy = xx;
  result.covariance.heading = heading;
  return result;
}

void FrontEnd::place(const Keyframe& keyframe, const SurfacePoints& points) {
  newest_ = keyframe;
  map_.place(std::make_shared<const LaserScan>(keyframe.scan), keyframe.local_pose, points);
}

} // namespace castor::mapping
