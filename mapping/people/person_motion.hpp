#pragma once

#include "castor/mapping/planar/poses.hpp"

namespace castor::mapping {

/// Where somebody is and how fast: a Kalman filter of constant velocity, the same on both axes.
class PersonMotion {
public:
  /// @param variance of the place, m^2
  /// @param speed standard deviation of the velocity, which is not known yet; m/s
  PersonMotion(const Point2& place, double variance, double speed)
    : place_(place), place_variance_(variance), velocity_variance_(speed * speed) {}

  /// @param dt seconds
  /// @param acceleration how much people change their velocity: root of the spectral density of
  /// their acceleration, m/s^1.5
  void predict(double dt, double acceleration);

  /// @param variance of the measured place, m^2
  void correct(const Point2& measured, double variance);

  /// The person has turned somewhere else: the velocity is not known any more.
  /// @param off how far off the place may be, metres
  /// @param speed standard deviation of the velocity, m/s
  void turn_away(double off, double speed);

  /// Slows down by that factor: nobody walks on unseen for ever.
  void slow_down(double factor);

  const Point2& place() const { return place_; }
  /// m/s.
  const Point2& velocity() const { return velocity_; }
  /// m^2, of the place on each axis.
  double variance() const { return place_variance_; }

private:
  Point2 place_;
  Point2 velocity_;
  double place_variance_;
  double covariance_ = 0;
  double velocity_variance_;
};

} // namespace castor::mapping
