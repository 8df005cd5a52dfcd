#pragma once

#include "castor/mapping/geometry/solid.hpp"

#include <optional>
#include <string>
#include <vector>

/// Solids by their outlines in a picture.
namespace castor::geometry {

/// A thing that stands on the table, as a picture shows it.
struct SeenSolid {
  Solid solid;
  /// Of its middle, in the frame of the camera's pose, whose plane z = 0 is the table.
  Pose pose;
  /// Root mean square of the distance of the outlines, pixels.
  double error = 0;
  /// Standard deviation of its height, where that was fitted by itself; metres. What is seen from
  /// above may be much higher than it seems.
  double height_deviation = 0;
};

/// Outlines that fit worse are partly hidden, or those of other shapes; pixels.
inline constexpr double good_outline_fit = 1.5;

/// The solid of this shape whose outline in the picture is nearest to that: position, turn and
/// sizes are fitted by damped least squares (Levenberg and Marquardt) to the supports of the
/// outline's convex hull. Nothing if its foot is not on the visible table.
/// @param shape "cube", "box", "cylinder", "sphere", or a flat piece: "square", "rectangle",
/// "circle", "disc", "triangle", which is a few millimetres thick and counts as what is round or
/// rectangular around it. Others count as boxes. Where other regions begin at the outline, the
/// solid may go on behind them.
/// @param contour image coordinates, through the centres of the outermost pixels
/// @param others contours of the other regions, with all their points
std::optional<SeenSolid> seen_solid(const std::string& shape, const std::vector<Point2>& contour,
                                    const Camera& camera,
                                    const std::vector<std::vector<Point2>>& others = {});

} // namespace castor::geometry
