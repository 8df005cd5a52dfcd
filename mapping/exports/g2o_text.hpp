#pragma once

#include "castor/mapping/exports/map_contents.hpp"

#include <string>

namespace castor::mapping {

/// The pose graph as text of the tool g2o (R. Kuemmerle et al., "g2o: a general framework for graph
/// optimization", 2011): lines `VERTEX_SE2 id x y theta` and `EDGE_SE2 from to dx dy dtheta` with
/// the upper triangle of the information matrix; the first vertex is fixed. A vertex's id is the
/// position of the keyframe.
/// @throws std::out_of_range for a constraint with a keyframe that is not there
std::string g2o_text(const MapContents& map);

} // namespace castor::mapping
