#pragma once

#include "castor/perception/vision/types.hpp"

#include <memory>
#include <optional>
#include <span>

namespace castor::vision {

/// A picture, prepared for comparing many boxes in it.
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

/// Appearance model of an object: its colour histogram, without positions, and its outline. Colour
/// histograms distinguish objects from the table, and are invariant to rotation and fast motion.
class Appearance {
public:
  /// \param region the pixels of the object's box, 3 channels.
  /// \param mask mask of the object, 1 channel; all pixels if it is empty.
  /// \throws std::invalid_argument for a mask of another size, or one without any pixel.
  explicit Appearance(const Image& region, const Image& mask = {});
  Appearance(Appearance&&) noexcept;
  Appearance& operator=(Appearance&&) noexcept;
  ~Appearance();

  /// Similarity of the picture in the box to the object: the Bhattacharyya coefficient of the
  /// colour histograms, 0 to 1. Parts of the box outside of the picture count as dissimilar.
  double similarity(const ColourPicture& picture, const ImageBox& box) const;

  /// The box of the given size with the highest similarity, outside of the `taken` ones; nothing if
  /// none has a similarity of at least `least`.
  std::optional<ImageBox> find(const ColourPicture& picture, double width, double height,
                               std::span<const ImageBox> taken, double least) const;

private:
  struct Look;
  std::unique_ptr<Look> look_;
};

} // namespace castor::vision
