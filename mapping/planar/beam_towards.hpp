#pragma once

#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <optional>

namespace castor::mapping {

/// The beam that is nearest to a point on the scanner; nothing unless there is one on each side of
/// it, too.
std::optional<std::size_t> beam_towards(const LaserScan& scan, const Point2& point);

} // namespace castor::mapping
