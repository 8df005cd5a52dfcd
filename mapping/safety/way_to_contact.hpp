#pragma once

#include "castor/mapping/building/polygon.hpp"
#include "castor/mapping/planar/poses.hpp"

namespace castor::mapping {

/// How far the middle of a disc of that radius moves until the disc touches `p`; metres along its
/// path, infinity if it never does. The disc begins at the origin towards x, and moves along a
/// circle of that curvature, 1/m, to the left if it is positive. If it touches the point already:
/// 0, or infinity if it moves away from it.
double way_to_contact(const Point2& p, double curvature, double radius);

/// The same for what has corners, until it is as near to `p` as `gap`, metres. If it is that near
/// already: 0 if it comes nearer still, or else the way until it will be as near again.
/// @param outline anticlockwise, of what begins with its middle at the origin
double way_to_contact(const Point2& p, double curvature, const Polygon& outline, double gap);

/// How far it turns about its middle until then, radians; infinity if it never comes that near.
/// @param is_left whether it turns to the left
double turn_to_contact(const Point2& p, bool is_left, const Polygon& outline, double gap);

} // namespace castor::mapping
