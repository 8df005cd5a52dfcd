#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "castor/perception/vision/camera/image_source.hpp"

/// What reads and writes the formats of pictures and videos. With OpenCV's codecs come some 150
/// libraries, which would be most of the time that a robot with rendered pictures takes to start;
/// so they are in a library of their own, which is loaded when the first file is read or written.
namespace castor::vision {

class ImageCodecs {
public:
  ImageCodecs() = default;
  ImageCodecs(const ImageCodecs&) = delete;
  ImageCodecs& operator=(const ImageCodecs&) = delete;
  virtual ~ImageCodecs() = default;

  /// In 8-bit B, G, R; without pixels if it cannot be decoded.
  virtual Image decode(std::span<const std::uint8_t> bytes) const = 0;

  /// \throws std::runtime_error with the reason if it cannot be encoded
  virtual std::vector<std::uint8_t> encode_png(const Image& image) const = 0;

  /// \throws ImageSourceError as open_image_source()
  virtual std::unique_ptr<ImageSource> open_video(const std::filesystem::path& path,
                                                  const ImageSourceOptions& options) const = 0;

  /// The device need not exist.
  /// \throws ImageSourceError as open_image_source()
  virtual std::unique_ptr<ImageSource> open_device(const std::filesystem::path& path,
                                                   const ImageSourceOptions& options) const = 0;
};

/// Name of the function of the library: `const ImageCodecs* ()`.
inline constexpr const char* image_codecs_function = "castor_image_codecs";

/// Loads the library, unless it is loaded.
/// \throws ImageSourceError unreadable if it is not beside that of vision, or cannot be loaded
const ImageCodecs& image_codecs();

} // namespace castor::vision
