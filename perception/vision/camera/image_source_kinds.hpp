#pragma once

#include <memory>

#include "castor/perception/vision/camera/image_source.hpp"

/// The kinds of sources behind open_image_source(), each for a path that exists, with
/// ImageSourceOptions::clock set.
namespace castor::vision {

std::unique_ptr<ImageSource> open_still(const std::filesystem::path& path,
                                        const ImageSourceOptions& options);

std::unique_ptr<ImageSource> open_folder(const std::filesystem::path& path,
                                         const ImageSourceOptions& options);

std::unique_ptr<ImageSource> open_scene(const std::filesystem::path& path,
                                        const ImageSourceOptions& options);

/// The calibration of the options, scaled to images of this size; without one, nominal_camera().
Camera camera_for(const ImageSourceOptions& options, int width, int height);

} // namespace castor::vision
