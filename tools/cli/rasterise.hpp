#pragma once

#include "castor/tools/timeline/contents.hpp"
#include "castor/tools/timeline/figure.hpp"

#include <optional>
#include <string>

namespace castor::cli {

/// A picture, scaled down to fit into width and height (pixels), as a PNG in a data URI. Nothing if
/// it has no pixels.
std::optional<timeline::EmbeddedPicture> embedded(const timeline::PictureView& x, double width,
                                                  double height);

/// The picture as a PNG file's content; empty if it is too large for one.
std::string as_png(const timeline::PictureView& x);

/// An SVG picture as a PNG file's content, `scale` times as large, or less if that is too large.
/// Throws std::runtime_error.
std::string as_png(const std::string& svg, double scale);

} // namespace castor::cli
