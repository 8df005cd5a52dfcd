#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/grid/cell_map.hpp"

#include <cstdint>
#include <vector>

namespace castor::benchmark {

/// People who walk between places of a map that were drawn, as long ways lead there: through doors,
/// and along corridors. Their speeds are 0.4 to 1 m/s. They begin at least 2 m from the robot.
std::vector<mapping::Walker> crowd(const mapping::CellMap& map, const mapping::Point2& robot,
                                   int count, std::uint64_t seed);

} // namespace castor::benchmark
