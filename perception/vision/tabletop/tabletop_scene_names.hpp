#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// The words of the scene language that name colours and shapes.
namespace castor::vision {

/// The colour of a common name, or of a "#rrggbb" with hexadecimal digits; lower case.
std::optional<SceneColour> colour_named(std::string_view word);

/// The shape of a name, or of one of its synonyms: block, brick, ball, can, plate, circle.
std::optional<TabletopShape> shape_named(std::string_view word);

const std::vector<std::string>& colour_names();
const std::vector<std::string>& shape_names();

/// Maximum count of numbers after `size`: 3 for a box, 2 for a rectangle and a cylinder, otherwise
/// 1.
std::size_t size_count(TabletopShape shape);

/// The size of an object from the numbers `given`, which may be empty; defaults:
/// - cube, square, triangle: the edge (0.06; flat pieces 0.08),
/// - sphere, disc: the diameter (0.06, 0.08),
/// - cylinder: diameter and height (0.06, 0.08; the height is 4/3 of the diameter if left out),
/// - rectangle: length along x, width along y (0.10, and half of the length if left out),
/// - box: length, width, height (0.10, then half of the length, then the width).
/// Flat pieces are 5 mm thick.
Point3 size_of(TabletopShape shape, const std::vector<double>& given);

} // namespace castor::vision
