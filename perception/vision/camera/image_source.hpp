#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "castor/perception/vision/camera/image_source_error.hpp"
#include "castor/perception/vision/camera/image_source_file.hpp"
#include "castor/perception/vision/types.hpp"

/// Sources of pictures: files, folders, videos, cameras, rendered scenes.
namespace castor::vision {

/// A picture and when it was taken.
struct Frame {
  /// 3 channels.
  Image image;
  /// By the clock of the options.
  std::chrono::microseconds time{0};
  /// Number of earlier frames.
  std::uint64_t index = 0;
  /// False if it is known to equal the frame before, except for noise; true of the first.
  bool changed = true;
};

struct ImageSourceOptions {
  /// Folder for relative names that are not in the working directory; none if empty.
  std::filesystem::path base_directory;
  /// Behaviour after the last picture of a folder or video.
  enum class AtEnd { loop, hold_last };
  AtEnd at_end = AtEnd::loop;
  ImageLimits limits;
  /// Size requested from a device, pixels; it may deliver another size.
  int device_width = 640;
  int device_height = 480;
  /// Camera for a source without its own, scaled to the size of its images; default:
  /// nominal_camera().
  std::optional<Camera> calibration;
  /// Time for frames and scenes; default: since the source was opened. A scene is shown as it is at
  /// that time.
  std::function<std::chrono::microseconds()> clock;
};

/// Delivers one picture after the other. Not safe for use by several threads at once.
class ImageSource {
public:
  ImageSource() = default;
  ImageSource(const ImageSource&) = delete;
  ImageSource& operator=(const ImageSource&) = delete;
  virtual ~ImageSource() = default;

  /// The next picture; waits for it, if it comes from a device.
  /// \throws ImageSourceError; after a transient one the next call may succeed. A folder
  ///         continues after a picture that it cannot read.
  virtual Frame next() = 0;

  /// Camera model of the pictures. Without a calibration it is assumed, and before the first frame
  /// of a video or device it may be for another size of image.
  virtual Camera camera() const = 0;

  /// Description for messages: "folder /data/table with 12 pictures".
  virtual std::string description() const = 0;

  /// Problems of the source that do not prevent its use.
  virtual std::vector<std::string> warnings() const { return {}; }
};

} // namespace castor::vision
