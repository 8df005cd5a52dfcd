#pragma once

#include "castor/mapping/rooms/raster.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace castor::mapping {

/// A corner of a room's outline: column and row of a cell.
using OutlineCorner = std::pair<int, int>;

/// The outer outline of the cells with a label, anticlockwise with rows that go up: centres of its
/// cells, but those on straight parts. If they are in several pieces, that of the largest.
std::vector<OutlineCorner> outline_of(const Raster<std::int32_t>& labels, std::int32_t label);

} // namespace castor::mapping
