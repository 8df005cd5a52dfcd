#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <functional>
#include <span>

namespace castor::mapping {

/// Somebody or something round that a walker keeps clear of.
struct AvoidedDisc {
  Point2 place;
  /// m/s.
  Point2 velocity;
  /// Distance to keep between the middles, metres.
  double reach = 0;
  /// The other keeps clear in the same way, so that each does half of what is necessary.
  bool is_mutual = false;
};

struct AvoidanceOptions {
  /// What is farther away than that is not avoided yet, seconds.
  double horizon = 3;
  /// How much of a velocity's deviation is worth a second more until a contact: the weight of the
  /// inverse time, metres.
  double caution = 2;
  /// That much is added for evading to the left, m/s: people who meet keep to the right.
  double left = 0.15;
  /// Weight of changes of the velocity.
  double steadiness = 0.2;
};

/// Seconds until two discs touch that go on as they do; `horizon` if not before. 0 if they overlap
/// and come closer.
/// @param place of the other, relative; metres
/// @param velocity of the other, relative; m/s
double time_to_contact(const Point2& place, const Point2& velocity, double reach, double horizon);

/// Velocity of somebody who wants to walk at `wanted`, among others: of some that are slower or
/// turned aside, the one with the least penalty for its deviation and for the inverse of the time
/// to a contact (reciprocal velocity obstacles, van den Berg et al. 2008). `wanted` itself if no
/// contact is near.
/// @param current m/s
/// @param is_free whether that velocity leads along where there is no wall
Point2 velocity_among(const Point2& here, const Point2& current, const Point2& wanted,
                      std::span<const AvoidedDisc> others,
                      const std::function<bool(const Point2&)>& is_free,
                      const AvoidanceOptions& options = {});

} // namespace castor::mapping
