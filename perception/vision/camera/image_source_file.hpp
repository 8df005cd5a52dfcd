#pragma once

#include <cstdint>
#include <filesystem>

#include "castor/perception/vision/camera/image_source_error.hpp"
#include "castor/perception/vision/types.hpp"

/// Pictures in files.
namespace castor::vision {

/// Limits for pictures; larger ones are refused.
struct ImageLimits {
  std::uint64_t max_pixels = 100'000'000;
  std::uint64_t max_bytes = 500'000'000;
};

/// Reads a PNG, JPEG, BMP, PNM, WebP or TIFF file. Grey, 16-bit and transparent pictures become
/// 8-bit B, G, R (transparency is dropped); a picture with an orientation tag is turned upright.
///
/// The size, and whether the file is complete, are checked before decoding: decoders fill missing
/// parts with grey without an error. Damage within the coded data of a JPEG is not detected, as it
/// has no checksum.
///
/// \throws ImageSourceError not_found, unreadable, not_an_image, truncated, too_large
Image read_image(const std::filesystem::path& path, const ImageLimits& limits = {});

/// Writes a picture with 1 or 3 channels.
/// \throws ImageSourceError unwritable, with the reason; no partial file is left.
/// \throws std::invalid_argument if the picture's bytes do not fit its size, or the size is zero.
void write_png(const std::filesystem::path& path, const Image& image);

/// Whether a file of this name may be a picture or a video, by its extension.
bool has_image_extension(const std::filesystem::path& path);
bool has_video_extension(const std::filesystem::path& path);

} // namespace castor::vision
