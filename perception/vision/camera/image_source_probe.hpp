#pragma once

#include <cstdint>
#include <optional>
#include <span>

/// Properties of a picture file, without decoding it.
namespace castor::vision {

enum class ImageFormat { png, jpeg, bmp, pnm, webp, tiff };

struct ImageProbe {
  ImageFormat format = ImageFormat::png;
  /// Pixels; zero if the file ends before the size, or has this size.
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  /// Whether the file is complete by its format: all chunks of a PNG with intact checksums, the end
  /// marker of a JPEG, all rows of a BMP or PNM, the length that a WebP states. Always true of a
  /// TIFF with a size, whose parts have no fixed order.
  bool complete = false;
};

/// Detects the format by the first bytes; nothing if it is none of ImageFormat. Never reads beyond
/// `bytes`, also for damaged files.
std::optional<ImageProbe> probe_image(std::span<const std::uint8_t> bytes);

} // namespace castor::vision
