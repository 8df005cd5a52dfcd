#include "castor/mapping/safety/safety_rules.hpp"

#include "castor/mapping/planar/beams.hpp"
#include "castor/mapping/planar/braking.hpp"
#include "castor/mapping/safety/way_to_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace castor::mapping {

namespace {

/// A robot that has moved less since then has stood, metres.
constexpr double stood = 0.01;
/// What comes towards the robot is faster than the noise of scans, and slower than anybody who
/// runs, m/s.
constexpr double slowest_approach = 0.35;
constexpr double fastest_approach = 2.5;
/// Number of scans between the two that are compared.
constexpr std::size_t compared = 2;
/// Slower robots are taken to drive the commanded arc already, m/s.
constexpr double slow = 0.05;
/// What was seen at the edge of the field of view may be beside it now: the wheels slip. Radians.
constexpr double edge = 0.1;
/// Side of the cells of what is remembered, metres.
constexpr double remembered_cell = 0.02;
/// Of the margin, which a robot that creeps keeps.
constexpr double creeping_share = 3;

std::vector<Point2> points_of(const LaserScan& x) {
  std::vector<Point2> result;
  result.reserve(x.ranges.size());
  for (std::size_t i = 0; i < x.ranges.size(); ++i)
    if (x.ranges[i] > 0)
      result.push_back(transform(x.mount, end_of_beam(x, i)));
  return result;
}

} // namespace

SafetyRules::SafetyRules(const SafetyOptions& options) : options_(options) {
  if (!options_.footprint)
    return;
  outline_ = options_.footprint->outline();
  if (signed_area(outline_) < 0)
    std::ranges::reverse(outline_);
  for (auto i = outline_.rbegin(); i != outline_.rend(); ++i)
    mirrored_outline_.push_back({-i->x, i->y});
  options_.radius = options_.footprint->outer_radius();
}

void SafetyRules::add(const LaserScan& x, std::int64_t now) {
  if (scan_ && x.time <= scan_->time)
    return;
  const auto newest = odometry_.newest();
  const auto pose = odometry_.pose_at(x.time).value_or(newest ? newest->pose : Pose2{});
  // Clocks of machines differ a little: nothing was measured after it has arrived.
  scan_time_ = std::min(x.time, now);
  const bool differs = !scan_ || x.ranges != scan_->ranges;
  if (differs)
    differed_at_ = pose;
  if (differs || (!options_.laser_has_noise && distance(differed_at_, pose) < stood))
    fresh_ = scan_time_;
  remember(x, pose);
  if (scan_)
    earlier_.push_back({std::move(*scan_), std::move(points_), scanned_at_});
  if (earlier_.size() > compared)
    earlier_.pop_front();
  points_ = points_of(x);
  scanned_at_ = pose;
  scan_ = x;
  moving_ = moved_points();
}

void SafetyRules::add(const Odometry& x, std::int64_t now) {
  const auto newest = odometry_.newest();
  if (newest && x.time <= newest->time)
    return;
  odometry_.add(x);
  odometry_time_ = std::min(x.time, now);
}

Twist2 SafetyRules::drivable(Twist2 x) const {
  if (options_.turning_radius > 0) {
    const double most = std::abs(x.forward) / options_.turning_radius;
    x.turn = std::clamp(x.turn, -most, most);
  }
  return x;
}

SafetyReason SafetyRules::failure(std::int64_t now) const {
  if (now - odometry_time_ > options_.odometry_patience.count())
    return SafetyReason::odometry_silent;
  if (now - scan_time_ > options_.laser_patience.count())
    return SafetyReason::laser_silent;
  if (now - fresh_ > options_.laser_patience.count())
    return SafetyReason::laser_frozen;
  return SafetyReason::none;
}

bool SafetyRules::sees(const LaserScan& scan, double direction, double inset) {
  using std::numbers::pi;
  const double seen = scan.angle_step * static_cast<double>(scan.ranges.size());
  if (seen > 2 * pi - scan.angle_step / 2)
    return true;
  const double from_first = normalised(direction - scan.mount.heading - scan.first_angle - pi) + pi;
  return from_first >= inset && from_first < seen - inset;
}

void SafetyRules::remember(const LaserScan& next, const Pose2& pose) {
  if (scan_) {
    const auto keep = [&](const std::vector<Point2>& points, std::chrono::microseconds how_long) {
      for (const auto& x : points) {
        const auto at = transform(scanned_at_, x);
        remembered_[{std::lround(at.x / remembered_cell), std::lround(at.y / remembered_cell)}] = {
          at, scan_->time + how_long.count()};
      }
    };
    keep(points_, outline_.empty() ? options_.memory : options_.standing_memory);
    keep(moving_, options_.memory);
  }
  const auto robot = inverse(pose);
  const auto scanner = inverse(compose(pose, next.mount));
  std::erase_if(remembered_, [&](const auto& cell) {
    const auto& x = cell.second;
    const auto seen = transform(scanner, x.point);
    const auto on_robot = transform(robot, x.point);
    return next.time > x.until ||
           std::hypot(on_robot.x, on_robot.y) > options_.radius + options_.memory_range ||
           sees(next, std::atan2(seen.y, seen.x) + next.mount.heading, edge);
  });
}

Pose2 SafetyRules::wheels_now(std::int64_t now) const {
  const auto wheels = *odometry_.newest();
  constexpr double microsecond = 1e-6;
  const double since = std::max(0.0, static_cast<double>(now - wheels.time) * microsecond);
  return moved(wheels.pose, wheels.velocity, since);
}

std::vector<Point2> SafetyRules::moved_points() const {
  std::vector<Point2> result;
  if (earlier_.empty())
    return result;
  const auto& scan = earlier_.front().scan;
  const auto beams = static_cast<int>(scan.ranges.size());
  const auto scanner = inverse(compose(earlier_.front().wheels, scan.mount));
  constexpr double far = 1.5;      // metres
  constexpr double farther = 0.12; // metres
  constexpr int beside = 2;        // beams
  for (const auto& x : points_) {
    const auto then = transform(scanner, transform(scanned_at_, x));
    const double away = distance(then, Point2{});
    if (away > far)
      continue;
    const double angle =
      std::remainder(std::atan2(then.y, then.x) - scan.first_angle, 2 * std::numbers::pi);
    const int middle = static_cast<int>(std::lround(angle / scan.angle_step));
    // Of a laser that looks all around, the last beam is beside the first.
    const int around = static_cast<int>(std::lround(2 * std::numbers::pi / scan.angle_step));
    bool was_free = true;
    for (int i = middle - beside; i <= middle + beside && was_free; ++i) {
      const int beam = (i + around) % around;
      was_free =
        beam<beams&& static_cast<double>(scan.ranges[static_cast<std::size_t>(beam)])> away +
        farther;
    }
    if (was_free)
      result.push_back(x);
  }
  return result;
}

SafetyRules::View SafetyRules::view_now(const Pose2& wheels) const {
  const auto from = [](const Pose2& frame, const std::vector<Point2>& points) {
    std::vector<Point2> result;
    for (const auto& x : points)
      result.push_back(transform(frame, x));
    return result;
  };
  const auto back = between(wheels, scanned_at_);
  View result{from(back, points_), from(back, moving_), {}};
  const auto from_wheels = inverse(wheels);
  for (const auto& [cell, x] : remembered_)
    result.points.push_back(transform(from_wheels, x.point));
  if (!earlier_.empty())
    result.before = from(between(wheels, earlier_.front().wheels), earlier_.front().points);
  return result;
}

SafetyRules::View SafetyRules::mirrored(View x) {
  x.side = -x.side;
  for (auto* part : {&x.points, &x.moving, &x.before})
    for (auto& p : *part)
      p.x = -p.x;
  return x;
}

double SafetyRules::way(const std::vector<Point2>& points, double curvature, double gap,
                        double side) const {
  double result = scan_->max_range;
  if (outline_.empty()) {
    for (const auto& x : points)
      result = std::min(result, way_to_contact(x, curvature, options_.radius + gap));
    return result;
  }
  // Its outermost point moves at most so far on a metre of way.
  const double farthest = 1 + std::abs(curvature) * options_.radius;
  for (const auto& x : points)
    if (distance(x, Point2{}) - options_.radius - gap < result * farthest)
      result = std::min(
        result, way_to_contact(x, curvature, side > 0 ? outline_ : mirrored_outline_, gap));
  return result;
}

double SafetyRules::turn(const View& view, bool is_left, double gap, double gap_of_moving) const {
  double result = std::numbers::pi;
  const auto look = [&](const std::vector<Point2>& points, double kept) {
    for (const auto& x : points)
      if (distance(x, Point2{}) < options_.radius + kept)
        result = std::min(result, turn_to_contact(x, is_left, outline_, kept));
  };
  look(view.points, gap);
  look(view.moving, gap_of_moving);
  return result;
}

double SafetyRules::approach(const View& view, double curvature) const {
  if (view.before.empty())
    return 0;
  constexpr double microsecond = 1e-6;
  const double nearer =
    way(view.before, curvature, 0, view.side) - way(view.points, curvature, 0, view.side);
  const double speed =
    nearer / (static_cast<double>(scan_->time - earlier_.front().scan.time) * microsecond);
  // What is nearer still was hidden before, or has come from the side.
  return speed < slowest_approach || speed > fastest_approach ? 0 : speed;
}

double SafetyRules::speed_along(const View& view, double curvature) const {
  // What approaches goes on while the robot reacts, and while it brakes.
  const double nearing = approach(view, curvature);
  // What has corners stops turning within some angle, and its corners may be faster than its middle.
  const double bend = outline_.empty() ? 0 : std::abs(curvature);
  const double braking = options_.turn_braking < bend * options_.braking
                           ? options_.turn_braking / bend
                           : options_.braking;
  const double creeping = options_.creeping / std::max(1.0, bend * options_.radius);
  const auto within = [&](double gap, double gap_of_moving) {
    const double left = std::min(way(view.points, curvature, gap, view.side),
                                 way(view.moving, curvature, gap_of_moving, view.side));
    return speed_to_stop_within(left - nearing * options_.latency,
                                options_.latency + nearing / braking, braking);
  };
  const double speed = within(options_.margin, options_.margin + options_.moving_margin);
  if (speed >= creeping)
    return speed;
  return std::min(creeping, within(options_.margin / creeping_share, options_.margin));
}

double SafetyRules::turn_speed(const View& view, bool is_left) const {
  const auto within = [&](double gap, double gap_of_moving) {
    return speed_to_stop_within(turn(view, is_left, gap, gap_of_moving), options_.latency,
                                options_.turn_braking);
  };
  const double creeping = options_.creeping / options_.radius;
  const double speed = within(options_.margin, options_.margin + options_.moving_margin);
  if (speed >= creeping)
    return speed;
  return std::min(creeping, within(options_.margin / creeping_share, options_.margin));
}

double SafetyRules::unseen_share(const Twist2& velocity) const {
  constexpr double step = 0.1; // metres
  double fastest = 0;
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const Segment side{outline_[i], outline_[(i + 1) % outline_.size()]};
    const double whole = length(side);
    const int pieces = static_cast<int>(std::ceil(whole / step));
    for (int k = 0; k <= pieces && whole > 0; ++k) {
      const auto p = point_at(side, static_cast<double>(k) / pieces);
      const double outwards =
        ((velocity.forward - velocity.turn * p.y) * (side.to.y - side.from.y) -
         velocity.turn * p.x * (side.to.x - side.from.x)) /
        whole;
      if (outwards > fastest &&
          !sees(*scan_, std::atan2(p.y - scan_->mount.y, p.x - scan_->mount.x)))
        fastest = outwards;
    }
  }
  return fastest > options_.unseen ? options_.unseen / fastest : 1;
}

SafetyRules::Verdict SafetyRules::with_corners(Verdict x, const View& view) const {
  if (x.velocity.forward == 0 && x.velocity.turn != 0)
    if (const double most = turn_speed(view, x.velocity.turn > 0);
        most < std::abs(x.velocity.turn)) {
      x.velocity.turn = std::copysign(most, x.velocity.turn);
      x.reason = SafetyReason::obstacle;
    }
  if (const double share = unseen_share(x.velocity); share < 1) {
    x.velocity = {share * x.velocity.forward, share * x.velocity.turn};
    x.reason = SafetyReason::unseen_side;
  }
  return x;
}

double SafetyRules::turn_while_braking(View view, const Twist2& driven,
                                       const Twist2& allowed) const {
  const double fast = std::abs(driven.forward);
  constexpr double little = 0.05; // m/s
  const bool goes_on = driven.forward * allowed.forward > 0;
  if (fast < slow || (goes_on && std::abs(allowed.forward) > fast - little))
    return allowed.turn;
  const double side = driven.forward > 0 ? 1 : -1;
  if (side < 0)
    view = mirrored(std::move(view));
  const auto way_with = [&](double turn) {
    return way(view.points, side * turn / fast, options_.margin, side);
  };
  if (way_with(allowed.turn) >= fast * options_.latency + fast * fast / (2 * options_.braking))
    return allowed.turn;
  double result = allowed.turn;
  for (const double x : {driven.turn, 0.0})
    if (way_with(x) > way_with(result))
      result = x;
  return result;
}

SafetyRules::Verdict SafetyRules::verdict(const std::optional<Twist2>& command,
                                          std::int64_t now) const {
  if (!command)
    return {{}, SafetyReason::no_command, 0};
  if (const auto reason = failure(now); reason != SafetyReason::none)
    return {{}, reason, 0};
  if (!std::isfinite(command->forward) || !std::isfinite(command->turn))
    return {{}, SafetyReason::no_command, 0};
  const auto commanded = drivable(*command);
  Verdict result{commanded, SafetyReason::none, scan_->max_range};
  const double wanted = std::abs(commanded.forward);
  const auto wheels = wheels_now(now);
  const auto seen = view_now(wheels);
  const auto velocity = odometry_.newest()->velocity;
  if (wanted == 0) {
    result.velocity.turn = turn_while_braking(seen, velocity, result.velocity);
    return outline_.empty() ? result : with_corners(result, seen);
  }
  // Driving backwards is driving forwards in a mirror behind the robot.
  const double side = commanded.forward > 0 ? 1 : -1;
  const auto view = side > 0 ? seen : mirrored(seen);
  const double curvature = side * commanded.turn / wanted;
  result.free_way = way(view.points, curvature, 0, side);
  double speed = speed_along(view, curvature);
  if (const double driven = side * velocity.forward; driven > slow) {
    // It leaves the arc that it drives only by and by.
    const double driven_curvature = side * velocity.turn / driven;
    for (const double x : {driven_curvature, (driven_curvature + curvature) / 2})
      speed = std::min(speed, speed_along(view, x));
  }
  if (speed < wanted)
    result.reason = SafetyReason::obstacle;
  if (outline_.empty() && !sees(*scan_, side > 0 ? 0 : std::numbers::pi) && options_.unseen < std::min(speed, wanted)) {
    speed = options_.unseen;
    result.reason = SafetyReason::unseen_side;
  }
  if (speed < wanted) {
    result.velocity.forward = side * speed;
    if (speed > 0)
      result.velocity.turn *= speed / wanted;
  }
  result.velocity.turn = turn_while_braking(seen, velocity, result.velocity);
  result.velocity = drivable(result.velocity);
  return outline_.empty() ? result : with_corners(result, seen);
}

} // namespace castor::mapping
