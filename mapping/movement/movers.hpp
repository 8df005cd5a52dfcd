#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <span>

namespace castor::mapping {

/// Somebody who walks, or something else that moves: a disc.
struct Mover {
  Point2 place;
  /// m/s.
  Point2 velocity;

  double speed() const { return distance(Point2{}, velocity); }
};

/// Where somebody is who goes on as he walks.
Point2 place_after(const Mover& x, double seconds);

struct MoverOptions {
  /// Footprints of the robot and of those who walk, metres.
  double robot_radius = 0.25;
  double mover_radius = 0.3;
  /// What is slower stands, m/s: it is an obstacle like others.
  double least_speed = 0.15;
  /// To be kept between the two, metres.
  double gap = 0.2;
  /// To be kept from those whom the robot passes at `near_speed`, in proportion less where it is
  /// slower, and so much more for each m/s that it is faster; metres, seconds.
  double passing_gap = 0.1;
  double passing_time = 0.6;
  /// How far it looks ahead, seconds.
  double horizon = 2.5;
  /// Within that distance from somebody, edge to edge, the robot drives at most so fast unless that
  /// one is behind it and the two part; metres, m/s.
  double near = 1;
  double near_speed = 0.3;
};

/// What a robot that passes somebody at that speed keeps from him, edge to edge, metres.
double gap_at(double speed, const MoverOptions& options);

/// How fast a robot may drive among those who walk, as a share of `wanted`, 0 to 1: so that nobody
/// who goes on as he walks comes nearer than the gap, unless he would if the robot stood, and not
/// sooner because it drives.
/// @param robot in the frame of the movers
double share_among_movers(const Pose2& robot, const Twist2& wanted, std::span<const Mover> movers,
                          const MoverOptions& options);

} // namespace castor::mapping
