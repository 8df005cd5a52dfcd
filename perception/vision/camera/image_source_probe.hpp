#pragma once

#include <cstdint>
#include <optional>
#include <span>

/// What the bytes of a picture file tell before anything is decoded.
namespace castor::vision {

enum class ImageFormat { png, jpeg, bmp, pnm, webp, tiff };

struct ImageProbe {
  ImageFormat format = ImageFormat::png;
  /// Pixels; zero if the file ends before it says, or says so itself.
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  /// Whether the file has the end that its format demands: all chunks of a PNG with intact
  /// checksums, the end marker of a JPEG, all rows of a BMP or PNM, the length that a WebP states.
  /// Always true of a TIFF with a size, whose parts may be anywhere.
  bool complete = false;
};

/// The format by the first bytes, not by any name; nothing if it is none of ImageFormat. Never
/// reads beyond `bytes`, whatever they are.
std::optional<ImageProbe> probe_image(std::span<const std::uint8_t> bytes);

} // namespace castor::vision
