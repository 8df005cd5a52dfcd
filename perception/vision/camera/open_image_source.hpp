#pragma once

#include <memory>
#include <string>

#include "castor/perception/vision/camera/image_source.hpp"

namespace castor::vision {

/// Opens the source `spec`:
/// - FILE: a picture (it is the same in each frame) or a video,
/// - FOLDER: its pictures in natural order, 2.png before 10.png, one per frame,
/// - /dev/videoN, or another character device: a camera,
/// - scene:FILE, or any FILE.scene: a scene, rendered. It is shown as its file says now: edits are
///   seen at once, and those with errors are a transient error, once.
///
/// \throws ImageSourceError if it cannot be opened: not_found, unknown_kind, unreadable,
/// not_an_image,
///         truncated, too_large, empty_folder, bad_scene, or, for a device, device_lost.
std::unique_ptr<ImageSource> open_image_source(const std::string& spec,
                                               const ImageSourceOptions& options = {});

} // namespace castor::vision
