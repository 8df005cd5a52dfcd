#pragma once

#include "castor/mapping/grid/cell_map.hpp"

namespace castor::mapping::test {

/// Ten by eight metres in cells of 5 cm from -0.5 -0.5, with furniture: no two places look alike.
CellMap furnished_map();

/// The same size without furniture: it looks the same after half a turn.
CellMap symmetric_map();

} // namespace castor::mapping::test
