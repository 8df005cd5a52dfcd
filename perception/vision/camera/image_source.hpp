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

/// Where pictures come from: files, folders, videos, cameras, rendered scenes.
namespace castor::vision {

/// A picture and when it was taken.
struct Frame {
  /// 3 channels.
  Image image;
  /// By the clock of the options.
  std::chrono::microseconds time{0};
  /// How many frames came before it.
  std::uint64_t index = 0;
  /// False if it is known to show the same as the frame before, but for noise; true of the first.
  bool changed = true;
};

struct ImageSourceOptions {
  /// Where relative names are looked for if they are not in the working directory; none if empty.
  std::filesystem::path base_directory;
  /// What comes after the last picture of a folder or video.
  enum class AtEnd { loop, hold_last };
  AtEnd at_end = AtEnd::loop;
  ImageLimits limits;
  /// What a device is asked for, pixels; it may deliver another size.
  int device_width = 640;
  int device_height = 480;
  /// The camera of a source that has none of its own, scaled to the size of its images;
  /// nominal_camera() if there is none.
  std::optional<Camera> calibration;
  /// How much time has passed; by default since the source was opened. A scene is shown as it is at
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
  /// \throws ImageSourceError; after a transient one the next call may succeed. A folder goes on
  /// with
  ///         the picture after one that it cannot read.
  virtual Frame next() = 0;

  /// The camera that the pictures are from. Without a calibration it is a guess, and before the
  /// first frame of a video or device it may be one for another size of image.
  virtual Camera camera() const = 0;

  /// The source in words, for messages: "folder /data/table with 12 pictures".
  virtual std::string description() const = 0;

  /// What is strange about the source, but does not keep it from working.
  virtual std::vector<std::string> warnings() const { return {}; }
};

} // namespace castor::vision
