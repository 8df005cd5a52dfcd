#include "castor/mapping/body/simulated_body.hpp"

#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace castor::mapping {

namespace {

/// Clearances are known up to here, metres.
constexpr double far_enough = 1;

/// A robot that was blocked no longer touches anything if it is that far away, metres.
constexpr double free_again = 0.02;

/// An outline that is so near to something touches it, metres.
constexpr double contact = 0.001;

/// Velocity of a body that moves by `motion` within `seconds`.
Twist2 velocity_of(const Pose2& motion, double seconds) {
  const double way = distance(Pose2{}, motion);
  return {(motion.x < 0 ? -way : way) / seconds, motion.heading / seconds};
}

double seconds(std::chrono::microseconds x) {
  return std::chrono::duration<double>(x).count();
}

} // namespace

BodySurroundings surroundings_in(const Building& x, const BodyOptions& options) {
  const auto solids = solids_of(x);
  BodySurroundings result;
  result.obstacles = std::make_unique<SolidObstacles>(between_heights(solids, 0, options.height));
  result.seen = std::make_unique<SolidObstacles>(
    between_heights(solids, options.laser_height, options.laser_height));
  result.start = x.start;
  if (options.people)
    result.people = x.people;
  return result;
}

SimulatedBody::SimulatedBody(BodySurroundings surroundings, const BodyOptions& options)
  : options_(options), surroundings_(std::move(surroundings)),
    // Seeds of its parts, so that one of them draws the same whatever the others do.
    drive_(options.drive, options.seed * 2), laser_(options.laser, options.seed * 2 + 1),
    people_(surroundings_.people, options.considerate), pose_(surroundings_.start), odometry_(options.odometry_start) {
  if (!(options.radius > 0) || options.step.count() <= 0 ||
      options.drive.max_forward * seconds(options.step) > options.radius)
    throw std::invalid_argument("a robot has to have a radius, and to drive less than that within "
                                "a step");
  clearance_ = least_clearance_ = clearance_of_robot_at(pose_);
}

double SimulatedBody::clearance_of_robot_at(const Pose2& pose) const {
  const auto result = room_at(pose);
  constexpr double rounding = 1e-9;
  if (result < -rounding)
    throw std::invalid_argument("the robot does not fit where it is to be: something is less than "
                                "its radius away; choose another place");
  return result;
}

void SimulatedBody::carry_to(const Pose2& pose) {
  clearance_ = clearance_of_robot_at(pose);
  pose_ = pose;
  drive_.stop();
  velocity_ = measured_velocity_ = {};
  blocked_ = false;
}

double SimulatedBody::room_at(const Pose2& pose) const {
  const auto clearance_at = [&](const Point2& p, double limit) {
    return clearance(*surroundings_.obstacles, people_.discs(), p, limit);
  };
  if (!options_.footprint)
    return clearance_at({pose.x, pose.y}, options_.radius + far_enough) - options_.radius;
  return options_.footprint->clearance(pose, [&](const Point2& p) {
    return clearance_at(p, far_enough);
  }) - contact;
}

void SimulatedBody::turn_blocked(const DifferentialDrive::Step& step, double here) {
  const Pose2 turned{pose_.x, pose_.y, normalised(pose_.heading + step.motion.heading)};
  if (options_.footprint) {
    const double there = room_at(turned);
    if (there < 0 && there < here)
      return drive_.stop();
  }
  pose_.heading = turned.heading;
  odometry_.heading = normalised(odometry_.heading + step.measured.heading);
}

bool SimulatedBody::is_pushed_on() const {
  const auto& wanted = drive_.commanded();
  if (wanted.forward == 0)
    return options_.footprint && wanted.turn != 0;
  return (wanted.forward < 0) == blocked_backwards_;
}

void SimulatedBody::command(const Twist2& velocity, std::chrono::microseconds holds) {
  drive_.command(velocity);
  const auto longest = std::chrono::microseconds::max() - time();
  commanded_until_ = time() + std::min(holds, longest);
}

void SimulatedBody::step() {
  if (time() >= commanded_until_)
    drive_.command({});
  const double dt = seconds(options_.step);
  const double size = options_.footprint ? options_.footprint->outer_radius() : options_.radius;
  people_.step(dt, {{pose_.x, pose_.y}, size}, *surroundings_.obstacles);
  const auto step = drive_.step(dt);
  auto next = compose(pose_, step.motion);
  const double here = room_at(pose_);
  double there = room_at(next);
  if (there < 0 && there < here && drive_.velocity().forward == 0) {
    // A disc can turn wherever it is; what its wheels slip does not push it into a wall.
    next = {pose_.x, pose_.y, next.heading};
    there = room_at(next);
  }
  const double forward = drive_.velocity().forward;
  const bool hits = there < 0 && there < here;
  const bool stays_blocked = blocked_ && there <= here;
  const double heading = pose_.heading;
  if (hits && !blocked_) {
    ++collisions_;
    blocked_ = true;
    blocked_backwards_ = forward < 0;
    drive_.stop();
    velocity_ = measured_velocity_ = {};
  } else if (hits || stays_blocked) {
    drive_.stop_driving();
    turn_blocked(step, here);
    const bool has_turned = pose_.heading != heading;
    velocity_ = {0, has_turned ? step.motion.heading / dt : 0};
    measured_velocity_ = {0, has_turned ? step.measured.heading / dt : 0};
  } else {
    driven_ += distance(pose_, next);
    pose_ = next;
    odometry_ = compose(odometry_, step.measured);
    velocity_ = velocity_of(step.motion, dt);
    measured_velocity_ = velocity_of(step.measured, dt);
  }
  clearance_ = hits || stays_blocked ? here : there;
  if (!is_pushed_on() || clearance_ > free_again)
    blocked_ = false;
  least_clearance_ = std::min(least_clearance_, clearance_);
  ++steps_;
}

Odometry SimulatedBody::odometry() const {
  return {time().count(), odometry_, measured_velocity_};
}

LaserScan SimulatedBody::scan() {
  if (options_.legs)
    return laser_.scan(*surroundings_.seen, people_.legs(), pose_, time().count());
  return laser_.scan(*surroundings_.seen, people_.discs(), pose_, time().count());
}

BodyStatus SimulatedBody::status() const {
  return {time().count(), pose_,      velocity_,        collisions_,
          blocked_,       clearance_, least_clearance_, driven_};
}

BodyState SimulatedBody::state() const {
  return {pose_, odometry_, collisions_, least_clearance_, driven_};
}

void SimulatedBody::resume(const BodyState& x) {
  pose_ = x.pose;
  odometry_ = x.odometry;
  collisions_ = x.collisions;
  least_clearance_ = x.least_clearance;
  driven_ = x.driven;
  drive_.stop();
  velocity_ = measured_velocity_ = {};
  clearance_ = room_at(pose_);
}

} // namespace castor::mapping
