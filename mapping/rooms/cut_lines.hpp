#pragma once

#include "castor/mapping/rooms/clearance_basins.hpp"
#include "castor/mapping/rooms/raster.hpp"

namespace castor::mapping {

/// Makes the boundaries between basins straight lines from wall to wall. A watershed's boundary
/// crosses a neck at its narrowest place, and then follows walls; and it lies anywhere in a passage
/// of constant width. So, again and again,
///
/// 1. for each two basins that meet, the cell of greatest clearance on their boundary is the neck;
///    if it lies in a passage of constant width, the end of this towards the larger basin;
/// 2. the shortest line through it between blocked cells is cut;
/// 3. what is then apart from the peak of its basin is given to the basins that it adjoins,
///
/// until the boundaries that remain have less clearance than `narrowest_neck` (cells).
/// @param clearance as from `clearance`, in cells
void straighten(Basins& basins, const Raster<float>& clearance, double narrowest_neck);

} // namespace castor::mapping
