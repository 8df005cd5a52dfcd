#pragma once

#include "castor/mapping/building/building.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

struct PictureOptions {
  /// Of the longer side without the margins, pixels.
  int size = 1400;
};

/// A plan of the building as a PNG file: rooms in pale colours with their names, walls, doors,
/// furniture, objects, routes of people, the start, and a scale.
/// \throws std::runtime_error if it has no extent.
std::vector<std::uint8_t> picture_of(const Building& x, const PictureOptions& options = {});

} // namespace castor::mapping
