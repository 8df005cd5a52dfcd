#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/generator_options.hpp"

namespace castor::mapping {

/// A building of rooms along a corridor, the same for the same options: a straight corridor with
/// rooms on both sides, or one that goes around a block of rooms, once or twice. A robot of
/// `checked_robot_radius` gets through all open doors, and around the furniture.
/// @throws std::invalid_argument if an option is out of its range
Building generate_building(const GeneratorOptions& options = {});

} // namespace castor::mapping
