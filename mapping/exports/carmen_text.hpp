#pragma once

#include "castor/mapping/exports/map_contents.hpp"

#include <string>

namespace castor::mapping {

/// The scans at their corrected poses as a log of the Carnegie Mellon Robot Navigation Toolkit
/// (CARMEN): lines `FLASER count ranges... x y theta odom_x odom_y odom_theta time host time` for
/// scanners that look over 180 degrees ahead, which is all that such a line can mean, and
/// `ROBOTLASER1`, which names its angles, for all others. x, y and theta are the corrected pose of
/// the scanner, as in the corrected logs of the SLAM benchmark (R. Kuemmerle et al., 2009). Beams
/// without a return have the maximal range.
std::string carmen_text(const MapContents& map);

} // namespace castor::mapping
