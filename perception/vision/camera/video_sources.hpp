#pragma once

#include <filesystem>
#include <memory>

#include "castor/perception/vision/camera/image_source.hpp"

/// What reads videos and cameras, which needs many libraries, and is in one of its own therefore.
namespace castor::vision {

/// What libcastor_video_sources has, by its function `const VideoSources* castor_video_sources()`.
/// Both throw ImageSourceError as open_image_source().
struct VideoSources {
  std::unique_ptr<ImageSource> (*open_video)(const std::filesystem::path& path,
                                             const ImageSourceOptions& options);
  /// The device need not exist.
  std::unique_ptr<ImageSource> (*open_device)(const std::filesystem::path& path,
                                              const ImageSourceOptions& options);
};

} // namespace castor::vision
