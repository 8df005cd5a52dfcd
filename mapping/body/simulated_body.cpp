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
    people_(surroundings_.people), pose_(surroundings_.start), odometry_(options.odometry_start) {
  if (!(options.radius > 0) || options.step.count() <= 0 ||
      options.drive.max_forward * seconds(options.step) > options.radius)
    throw std::invalid_argument("a robot has to have a radius, and to drive less than that within "
                                "a step");
  clearance_ = least_clearance_ = clearance_of_robot_at(pose_);
}

double SimulatedBody::clearance_of_robot_at(const Pose2& pose) const {
  auto result = clearance_at(pose, options_.radius + far_enough) - options_.radius;
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

double SimulatedBody::clearance_at(const Pose2& pose, double limit) const {
  return clearance(*surroundings_.obstacles, people_.discs(), {pose.x, pose.y}, limit);
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
  people_.step(dt, {{pose_.x, pose_.y}, options_.radius}, *surroundings_.obstacles);
  const auto step = drive_.step(dt);
  auto next = compose(pose_, step.motion);
  const double reach = options_.radius + far_enough;
  const double here = clearance_at(pose_, reach);
  double there = clearance_at(next, reach);
  if (there < options_.radius && there < here && drive_.velocity().forward == 0) {
    // A disc can turn wherever it is; what its wheels slip does not push it into a wall.
    next = {pose_.x, pose_.y, next.heading};
    there = here;
  }
  const double forward = drive_.velocity().forward;
  const bool hits = there < options_.radius && there < here;
  const bool stays_blocked = blocked_ && there <= here;
  if (hits && !blocked_) {
    ++collisions_;
    blocked_ = true;
    blocked_backwards_ = forward < 0;
    drive_.stop();
    velocity_ = measured_velocity_ = {};
  } else if (hits || stays_blocked) {
    // It may turn.
    drive_.stop_driving();
    pose_.heading = next.heading;
    odometry_.heading = normalised(odometry_.heading + step.measured.heading);
    velocity_ = {0, step.motion.heading / dt};
    measured_velocity_ = {0, step.measured.heading / dt};
  } else {
    driven_ += distance(pose_, next);
    pose_ = next;
    odometry_ = compose(odometry_, step.measured);
    velocity_ = velocity_of(step.motion, dt);
    measured_velocity_ = velocity_of(step.measured, dt);
  }
  const double now = hits || stays_blocked ? here : there;
  const double wanted = drive_.commanded().forward;
  if (wanted == 0 || (wanted < 0) != blocked_backwards_ || now > options_.radius + free_again)
    blocked_ = false;
  clearance_ = now - options_.radius;
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
  clearance_ = clearance_at(pose_, options_.radius + far_enough) - options_.radius;
}

} // namespace castor::mapping
