#pragma once

#include "castor/mapping/planar/poses.hpp"

namespace castor::mapping {

/// How far the middle of a disc of that radius moves until the disc touches `p`; metres along its
/// path, infinity if it never does. The disc begins at the origin towards x, and moves along a
/// circle of that curvature, 1/m, to the left if it is positive. If it touches the point already:
/// 0, or infinity if it moves away from it.
double way_to_contact(const Point2& p, double curvature, double radius);

} // namespace castor::mapping
