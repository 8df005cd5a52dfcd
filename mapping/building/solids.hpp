#pragma once

#include "castor/mapping/building/building.hpp"

#include <vector>

namespace castor::mapping {

/// Height of the openings that doors are, metres; above them is wall.
inline constexpr double door_height = 2.05;

/// Everything in the building that is in the way, without people: pieces of wall around doors,
/// shut doors, furniture, objects.
/// \pre the doors know their walls.
std::vector<Solid> solids_of(const Building& x);

/// Those that reach into the heights from `low` to `high`.
std::vector<Solid> between_heights(const std::vector<Solid>& solids, double low, double high);

} // namespace castor::mapping
