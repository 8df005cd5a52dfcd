#pragma once

#include "castor/mapping/rooms/raster.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

/// A part of the free space: what is nearer to one place of great clearance than to others.
struct Basin {
  /// Cell with the greatest clearance.
  int peak = 0;
  /// Of that cell, in cells.
  float clearance = 0;
};

struct Basins {
  /// Index in `basins` of each free cell, else -1.
  Raster<std::int32_t> labels;
  std::vector<Basin> basins;
};

/// Floods the free space from the cells with the greatest clearance to those with the least
/// (a watershed). Where two basins meet there is a neck, as wide as twice its clearance. They stay
/// apart if the neck's clearance is less than `neck_ratio` of the lesser one of their peaks, and
/// become one otherwise.
/// @param clearance as from `clearance`, in cells
Basins clearance_basins(const Raster<float>& clearance, double neck_ratio);

} // namespace castor::mapping
