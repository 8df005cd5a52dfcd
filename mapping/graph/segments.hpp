#pragma once

#include "castor/mapping/planar/poses.hpp"

namespace castor::mapping {

/// A straight line between two points of the floor.
struct Line2 {
  Point2 a;
  Point2 b;
};

/// Distance of a point from the nearest point of the line.
double distance(const Line2& line, const Point2& p);

/// Whether the two lines have a point in common; those along the same line have none.
bool cross(const Line2& x, const Line2& y);

} // namespace castor::mapping
