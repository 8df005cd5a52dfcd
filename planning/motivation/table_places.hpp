#pragma once

#include "castor/planning/motivation/table_things.hpp"

#include <span>
#include <string>

namespace castor::planning {

/// Where a place is, in words: by the nearest other thing that is not held, "to the left of where
/// the red cube is now", or by the part of the table, "on the left", if none is within 25 cm.
/// @param own the thing that the place is said for
std::string place_in_words(const TableSpot& place, const TableThing& own,
                           std::span<const TableThing> table);

} // namespace castor::planning
