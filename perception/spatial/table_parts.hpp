#pragma once

#include "castor/perception/spatial/types.hpp"

#include <optional>
#include <string_view>

namespace castor::spatial {

/// What things may be put on, metres: x to the right of who looks at it, y away.
struct TableArea {
  GroundPoint low{-0.30, -0.26};
  GroundPoint high{0.30, 0.26};

  GroundPoint middle() const { return {(low.x + high.x) / 2, (low.y + high.y) / 2}; }
};

/// How far from an edge something may end that is said to be at it, metres.
inline constexpr double edge_width = 0.06;

/// How far from the front edge somebody who sits there reaches with ease, metres.
inline constexpr double hand_reach = 0.35;

/// How well a disc of some radius, metres, is in a part of the table: from above 0, where it is at
/// the part's border, to 1 and more; 0 or less if it is not. Nothing for what is no part. Parts are
/// left, right, front, back, left-edge ..., their middles, such as front-middle, edge,
/// front-left-corner ..., corner, front-left ..., the quarters of the table, the better the nearer
/// to their corners, centre, table, at-hand, the better the nearer to the middle half of the front
/// edge, and strip-I-of-N: the I-th of N strips, from the left.
std::optional<double> fit_in_part(std::string_view part, const TableArea& area,
                                  const GroundPoint& centre, double radius);

/// Whether fit_in_part() knows it.
bool is_part_of_table(std::string_view part);

/// "At the front in the middle", "in the middle of the front edge".
bool is_middle_of_side(std::string_view part);

/// The way to a side of the table, to its edge, or to the middle of either, of length 1; nothing
/// for other parts.
std::optional<GroundPoint> way_to_side(std::string_view part);

/// How clearly a point is on that side: 0 in the middle of the table, 1 from some way towards its
/// edge on.
double clearness_on_side(const GroundPoint& way, const TableArea& area, const GroundPoint& centre);

} // namespace castor::spatial
