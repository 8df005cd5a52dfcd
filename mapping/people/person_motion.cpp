#include "castor/mapping/people/person_motion.hpp"

namespace castor::mapping {

void PersonMotion::predict(double dt, double acceleration) {
  place_.x += velocity_.x * dt;
  place_.y += velocity_.y * dt;
  // White noise of the acceleration (Bar-Shalom et al. 2001, section 6.2.2).
  const double q = acceleration * acceleration;
  place_variance_ += 2 * dt * covariance_ + dt * dt * velocity_variance_ + q * dt * dt * dt / 3;
  covariance_ += dt * velocity_variance_ + q * dt * dt / 2;
  velocity_variance_ += q * dt;
}

void PersonMotion::correct(const Point2& measured, double variance) {
  const double sum = place_variance_ + variance;
  const double gain = place_variance_ / sum;
  const double velocity_gain = covariance_ / sum;
  const Point2 off{measured.x - place_.x, measured.y - place_.y};
  place_.x += gain * off.x;
  place_.y += gain * off.y;
  velocity_.x += velocity_gain * off.x;
  velocity_.y += velocity_gain * off.y;
  velocity_variance_ -= velocity_gain * covariance_;
  covariance_ *= 1 - gain;
  place_variance_ *= 1 - gain;
}

void PersonMotion::turn_away(double off, double speed) {
  place_variance_ += off * off;
  velocity_ = {};
  covariance_ = 0;
  velocity_variance_ = speed * speed;
}

void PersonMotion::slow_down(double factor) {
  velocity_.x *= factor;
  velocity_.y *= factor;
}

} // namespace castor::mapping
