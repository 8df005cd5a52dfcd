#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/generator_options.hpp"
#include "castor/mapping/building/seeded_uniform.hpp"

#include <cmath>
#include <vector>

namespace castor::mapping {

/// A part of the floor along the axes.
struct Rectangle {
  Point2 low;
  Point2 high;

  Point2 middle() const { return {(low.x + high.x) / 2, (low.y + high.y) / 2}; }
  double length() const { return high.x - low.x; }
  double width() const { return high.y - low.y; }
};

/// Generated lengths are whole centimetres.
inline double to_centimetre(double metres) {
  return std::round(metres * 100) / 100;
}

/// Walls, doors and rooms of a generated building.
struct FloorLayout {
  Building building;
  /// Of the building's rooms but the last one, which is the corridor.
  std::vector<Rectangle> rooms;
  /// Whose union the corridor is; each touches the one before.
  std::vector<Rectangle> corridor;
};

/// The same for the same options and random numbers.
FloorLayout lay_out_floor(const GeneratorOptions& options, SeededUniform& random);

} // namespace castor::mapping
