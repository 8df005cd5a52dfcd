#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

/// Pictures with regions and labels drawn on them, for what the system recognises.
namespace castor::vision {

/// A line of a label; with a confidence in [0, 1] it is shown as a bar and in per cent.
struct AnnotationLine {
  std::string text;
  std::optional<double> confidence;

  friend bool operator==(const AnnotationLine&, const AnnotationLine&) = default;
};

struct BgrColour {
  std::uint8_t blue = 0;
  std::uint8_t green = 0;
  std::uint8_t red = 0;

  friend bool operator==(const BgrColour&, const BgrColour&) = default;
};

/// Drawing for a region of a picture.
struct Annotation {
  /// Pixels of the picture; drawn if there is no contour.
  ImageBox box;
  /// The outline, pixels of the picture; may be empty.
  std::vector<Point2> contour;
  /// Lines of the label, the heading first; without lines there is no label. Characters other than
  /// ASCII are shown as question marks.
  std::vector<AnnotationLine> lines;
  /// Default: annotation_colour() of the annotation's index.
  std::optional<BgrColour> colour;
};

struct AnnotateOptions {
  /// A picture whose longer side has fewer pixels is enlarged by a whole factor to at least that,
  /// so that labels are legible.
  std::uint32_t min_side = 600;
  /// Opacity of the regions' fill, in [0, 1].
  double fill_opacity = 0.12;
  /// Opacity of the labels' background, in [0, 1].
  double label_opacity = 0.78;
  /// Height of the letters, relative to the default.
  double text_scale = 1.0;
};

/// One of eight colours that are easy to tell apart on wood and on cloth.
BgrColour annotation_colour(std::size_t index);

/// Draws outlines, translucent fills and labels on a copy of `image`, which may have 1 or 3
/// channels; the result has 3. Labels are put beside their regions, within the picture, and away
/// from each other and from other regions as far as there is room; a line leads to the region if
/// need be. Coordinates may be outside of the picture; annotations with coordinates that are not
/// finite are left out. \throws std::invalid_argument if the picture is empty or its bytes do not
/// fit its size.
Image annotate(const Image& image, std::span<const Annotation> annotations,
               const AnnotateOptions& options = {});

/// The image, shrunk to at most `width` pixels across. \throws std::invalid_argument as `annotate`.
Image shrunk(const Image& image, std::uint32_t width);

} // namespace castor::vision
