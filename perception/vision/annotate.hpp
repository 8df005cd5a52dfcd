#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

/// Pictures with drawings on them that say what the system takes the things in them for.
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

/// What to draw about a region of a picture.
struct Annotation {
  /// Pixels of the picture; drawn if there is no contour.
  ImageBox box;
  /// The outline, pixels of the picture; may be empty.
  std::vector<Point2> contour;
  /// What the label says, the heading first; without lines there is no label. Letters other than
  /// ASCII are shown as a question mark.
  std::vector<AnnotationLine> lines;
  /// From annotation_colour() by the annotation's position, if there is none.
  std::optional<BgrColour> colour;
};

struct AnnotateOptions {
  /// A picture whose longer side has fewer pixels is enlarged by a whole factor to at least that,
  /// so that labels are legible.
  std::uint32_t min_side = 600;
  /// Of the regions' fill, in [0, 1].
  double fill_opacity = 0.12;
  /// Of the labels' ground, in [0, 1].
  double label_opacity = 0.78;
  /// Of the letters, in proportion to the usual height.
  double text_scale = 1.0;
};

/// One of eight colours that are easy to tell apart on wood and on cloth.
BgrColour annotation_colour(std::size_t index);

/// Draws outlines, translucent fills and labels on a copy of `image`, which may have 1 or 3
/// channels; the result has 3. Labels are put beside their regions, within the picture, and away
/// from each other and from other regions as far as there is room; a line leads to the region if
/// need be. Coordinates that are outside of the picture are fine; annotations whose coordinates are
/// no numbers are left out. \throws std::invalid_argument if the picture is empty or its numbers
/// contradict each other.
Image annotate(const Image& image, std::span<const Annotation> annotations,
               const AnnotateOptions& options = {});

/// The image, so much smaller that it is no wider than `width`. \throws std::invalid_argument as
/// `annotate`.
Image shrunk(const Image& image, std::uint32_t width);

} // namespace castor::vision
