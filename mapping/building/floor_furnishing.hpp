#pragma once

#include "castor/mapping/building/floor_layout.hpp"

namespace castor::mapping {

/// Puts furniture and objects into the rooms and the corridor, so that a robot still gets through
/// all open doors and everywhere around the furniture. What finds no place in some tries is left
/// out.
void furnish_floor(FloorLayout& floor, const GeneratorOptions& options, SeededUniform& random);

} // namespace castor::mapping
