#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <vector>

namespace castor::mapping {

/// Corners in order, the last one joined to the first.
using Polygon = std::vector<Point2>;

struct Segment {
  Point2 from;
  Point2 to;

  friend bool operator==(const Segment&, const Segment&) = default;
};

double length(const Segment& x);

/// Point at `share` of the way: `from` at 0, `to` at 1.
Point2 point_at(const Segment& x, double share);

/// Where on the segment the point nearest to `p` is, as a share of its length, within [0, 1].
double nearest_share(const Segment& x, const Point2& p);

double distance(const Segment& x, const Point2& p);

/// Square metres; positive if the corners are in anticlockwise order.
double signed_area(const Polygon& x);

/// Whether the point is inside; on the boundary either answer is possible.
bool contains(const Polygon& x, const Point2& p);

/// A point inside that is far from the boundary, for a label: the best one of a grid of candidates.
/// @param holes that the point must not be in
/// \pre the polygon has an area.
Point2 label_point(const Polygon& x, const std::vector<Polygon>& holes);

} // namespace castor::mapping
