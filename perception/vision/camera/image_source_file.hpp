#pragma once

#include <cstdint>
#include <filesystem>

#include "castor/perception/vision/camera/image_source_error.hpp"
#include "castor/perception/vision/types.hpp"

/// Pictures in files.
namespace castor::vision {

/// What is taken for a mistake rather than for a picture.
struct ImageLimits {
  std::uint64_t max_pixels = 100'000'000;
  std::uint64_t max_bytes = 500'000'000;
};

/// Reads a PNG, JPEG, BMP, PNM, WebP or TIFF file. Grey, 16-bit and transparent pictures become
/// 8-bit B, G, R (transparency is dropped); a picture is turned upright if it says how it was
/// taken.
///
/// The size is checked before anything is decoded, and so is whether the file is complete: decoders
/// fill what is missing with grey and say nothing. Damage within the coded data of a JPEG is not
/// noticed, as it has no checksum.
///
/// \throws ImageSourceError not_found, unreadable, not_an_image, truncated, too_large
Image read_image(const std::filesystem::path& path, const ImageLimits& limits = {});

/// Writes a picture with 1 or 3 channels.
/// \throws ImageSourceError unwritable, with the reason; nothing is left behind then.
/// \throws std::invalid_argument if the picture's numbers contradict each other or are zero.
void write_png(const std::filesystem::path& path, const Image& image);

/// Whether a file of this name may be a picture or a video, by its extension.
bool has_image_extension(const std::filesystem::path& path);
bool has_video_extension(const std::filesystem::path& path);

} // namespace castor::vision
