#pragma once

#include <cstdint>
#include <string>

namespace castor::cli {

/// The Foxglove schemas that are written (https://docs.foxglove.dev/docs/sdk/schemas).
enum class FoxgloveSchema : std::uint8_t {
  compressed_image,
  camera_calibration,
  frame_transform,
  poses_in_frame,
  scene_update,
};

/// "foxglove.CompressedImage"
std::string name_of(FoxgloveSchema x);

/// As JSON Schema.
std::string text_of(FoxgloveSchema x);

} // namespace castor::cli
