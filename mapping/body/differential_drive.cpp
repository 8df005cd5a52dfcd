#include "castor/mapping/body/differential_drive.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

namespace {

double approach(double now, double wanted, double most) {
  return now + std::clamp(wanted - now, -most, most);
}

/// Motion of the body if its wheels move that far.
Pose2 body_motion(double left, double right, double wheel_base) {
  return moved({}, {(left + right) / 2, (right - left) / wheel_base}, 1);
}

} // namespace

DifferentialDrive::DifferentialDrive(const DriveOptions& options, std::uint64_t seed)
  : options_(options), noise_(seed), left_error_(noise_.gaussian(options.diameter_error)),
    right_error_(noise_.gaussian(options.diameter_error)) {
  // nop
}

void DifferentialDrive::command(const Twist2& velocity) {
  // What is no number is no velocity.
  auto limited = [](double x, double limit) {
    return std::isfinite(x) ? std::clamp(x, -limit, limit) : 0.0;
  };
  commanded_ = {limited(velocity.forward, options_.max_forward),
                limited(velocity.turn, options_.max_turn)};
}

double DifferentialDrive::slipped(double way, double diameter_error) {
  return way * (1 + diameter_error) + noise_.gaussian(options_.slip * std::sqrt(std::abs(way)));
}

DifferentialDrive::Step DifferentialDrive::step(double dt) {
  velocity_.forward = approach(velocity_.forward, commanded_.forward, options_.acceleration * dt);
  velocity_.turn = approach(velocity_.turn, commanded_.turn, options_.turn_acceleration * dt);
  if (options_.turning_radius > 0) {
    const double most = std::abs(velocity_.forward) / options_.turning_radius;
    velocity_.turn = std::clamp(velocity_.turn, -most, most);
  }
  const double aside = velocity_.turn * options_.wheel_base / 2;
  const double left = blocked_ == Wheel::left ? 0 : (velocity_.forward - aside) * dt;
  const double right = blocked_ == Wheel::right ? 0 : (velocity_.forward + aside) * dt;
  Step result;
  result.measured = body_motion(left, right, options_.wheel_base);
  const double true_left = slipped(left, left_error_);
  const double true_right = slipped(right, right_error_);
  result.motion = body_motion(true_left, true_right, options_.wheel_base);
  return result;
}

} // namespace castor::mapping
