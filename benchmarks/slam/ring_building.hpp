#pragma once

#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/building/building.hpp"

#include <cstdint>

namespace castor::slam_benchmark {

/// A corridor all around a block, with open doors to rooms in it. Metres.
struct RingOptions {
  /// Of the corridor's outer wall.
  double width = 40;
  double height = 26;
  double corridor = 2;
  /// Distance of the doors from each other.
  double door_spacing = 4;
  /// All rooms and doors look alike, and the corridor is empty; otherwise there are cabinets at
  /// random places in both.
  bool is_repeating = false;
  std::uint64_t seed = 1;
};

/// \throws std::invalid_argument if the options leave no place for the block.
mapping::Building ring_building(const RingOptions& options);

/// From the building's start along the middle of the corridor, `rounds` times around.
mapping::Path path_around(const RingOptions& options, double rounds);

} // namespace castor::slam_benchmark
