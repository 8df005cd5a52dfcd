#pragma once

#include "castor/mapping/movement/clearance_map.hpp"

#include <cstdint>

namespace castor::mapping {

/// How a robot moves whose footprint is no disc.
enum class PoseSteering {
  /// It turns on the spot and drives straight on.
  turn_and_drive,
  /// It drives on circles and straight on, forwards and backwards, as a car does (J. A. Reeds and
  /// L. A. Shepp, "Optimal paths for a car that goes both forwards and backwards", Pacific Journal
  /// of Mathematics 145(2), 1990).
  reeds_shepp
};

struct PosePlanOptions {
  PoseSteering steering = PoseSteering::turn_and_drive;
  /// What is kept between the footprint and obstacles, metres. Of a start with less, what there is.
  double margin = 0.05;
  /// Of the circles of `reeds_shepp`, metres.
  double turning_radius = 0.6;
  /// What a turn of a radian on the spot counts, in metres; and how much longer a way backwards
  /// counts, where the laser may not look.
  double turn_weight = 0.3;
  double backwards_weight = 1.5;
  ClearanceOptions cells;
  /// It gives up after so many seconds.
  double time_limit = 2;
  /// It searches so often, and takes the best way; more often if none was found.
  int attempts = 3;
  /// Of each of the first searches, so that they find the same on each machine; later ones take
  /// more.
  unsigned steps = 1'000;
  std::uint32_t seed = 1;
};

} // namespace castor::mapping
