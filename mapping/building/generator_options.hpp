#pragma once

#include <cstdint>

namespace castor::mapping {

/// Options of generate_building().
struct GeneratorOptions {
  std::uint64_t seed = 1;
  /// Beside the corridor, which is a room as well; at least 2, at most 60.
  int rooms = 8;
  /// Metres, of a room along the corridor and away from it.
  double least_side = 3.2;
  double greatest_side = 5.2;
  double least_corridor = 1.6;
  double greatest_corridor = 2.2;
  double least_door = 0.8;
  double greatest_door = 1.0;
  /// Share of the doors to the corridor that are shut.
  double shut_doors = 0.12;
  /// Share of the walls between two rooms that have a door, which makes loops.
  double connecting_doors = 0.25;
  /// Share of the rooms that have a second door where a corridor is on two sides of them.
  double second_doors = 0.3;
  /// The most for a room, of which some may find no place.
  int furniture = 5;
  int objects = 3;
  int walkers = 2;
};

} // namespace castor::mapping
