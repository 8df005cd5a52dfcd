#pragma once

#include "castor/planning/motivation/table_room.hpp"

#include <vector>

namespace castor::planning {

/// Places for groups of things, from left to right in that order, so that those of a group stand
/// together: each is nearer to one of its own group than to any of another. What stands so already
/// stays, as few as possible are moved, no farther than they have to, and where they can be put.
///
/// @param groups two at least, of things of the table
/// @returns a spot for each of the things, in the order of the groups; none if there is no room
std::vector<TableSpot> grouped(const std::vector<std::vector<const TableThing*>>& groups,
                               const TableRoom& room);

} // namespace castor::planning
