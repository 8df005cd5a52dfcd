#pragma once

#include "castor/perception/vision/types.hpp"

#include <memory>
#include <optional>
#include <span>

namespace castor::vision {

/// A picture, prepared for looking at many boxes in it.
class ColourPicture {
public:
  /// \throws std::invalid_argument unless the image has pixels, of 3 channels.
  explicit ColourPicture(const Image& image);
  ColourPicture(ColourPicture&&) noexcept;
  ColourPicture& operator=(ColourPicture&&) noexcept;
  ~ColourPicture();

private:
  friend class Appearance;
  struct Pixels;
  std::unique_ptr<Pixels> pixels_;
};

/// What a thing looks like: the colours it has, wherever in it, and its outline. Colour histograms
/// tell things on a table from the table, and survive turns and fast motion.
class Appearance {
public:
  /// \param region the pixels of the thing's box, 3 channels.
  /// \param mask which of them are the thing's, 1 channel; all, if it is empty.
  /// \throws std::invalid_argument for a mask of another size, or one without any pixel.
  explicit Appearance(const Image& region, const Image& mask = {});
  Appearance(Appearance&&) noexcept;
  Appearance& operator=(Appearance&&) noexcept;
  ~Appearance();

  /// How much the picture within the box looks like the thing, if the box is its outline: the
  /// Bhattacharyya coefficient of the colour histograms, 0 to 1. What is beyond the picture looks
  /// like nothing.
  double similarity(const ColourPicture& picture, const ImageBox& box) const;

  /// The box of the given size that looks most like the thing, outside of the `taken` ones; nothing
  /// if none has a similarity of `least`.
  std::optional<ImageBox> find(const ColourPicture& picture, double width, double height,
                               std::span<const ImageBox> taken, double least) const;

private:
  struct Look;
  std::unique_ptr<Look> look_;
};

} // namespace castor::vision
