#pragma once

#include <filesystem>
#include <memory>

#include "castor/perception/vision/camera/image_source.hpp"

/// Videos and cameras, by OpenCV.
namespace castor::vision {

std::unique_ptr<ImageSource> open_video(const std::filesystem::path& path,
                                        const ImageSourceOptions& options);

/// The device need not exist.
std::unique_ptr<ImageSource> open_device(const std::filesystem::path& path,
                                         const ImageSourceOptions& options);

} // namespace castor::vision
