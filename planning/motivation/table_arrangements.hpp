#pragma once

#include "castor/planning/motivation/table_room.hpp"

#include <string_view>
#include <vector>

namespace castor::planning {

/// Places for all of some things, so that they stand in a row from left to right, in a column, in a
/// ring, or farther from each other. Each keeps its rank among the others, but in a row "as named"
/// they stand in the order in which they are given; they go no farther than they have to, where
/// they can be put, and where others stand that are not moved before, none is put. As few as
/// possible are moved. Neighbours in a row or a column are as
/// far from each other, from rim to rim.
///
/// @param things two at least, of the table
/// @param side of the table where all of them are to be: left, right, front, back, or the edge
///     there, such as left-edge, along which a row goes, as near to it as can be; or
///     towards-left-edge, which need not be clearly there; or centre, for a line through it; or
///     empty
/// @returns a spot for each of the things, "spot-of-" and its object; none if there is no room
std::vector<TableSpot> arranged(std::string_view arrangement,
                                const std::vector<const TableThing*>& things, const TableRoom& room,
                                std::string_view side = {});

} // namespace castor::planning
