#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace castor::vision {

/// Reason why there is no picture.
enum class ImageFault {
  /// Neither a file, a folder, a device nor a kind of source is called so.
  not_found,
  unknown_kind,
  /// It exists, but may not be read, or reading it fails.
  unreadable,
  /// It is not a picture or video in a supported format.
  not_an_image,
  /// It is a picture that ends early or is damaged.
  truncated,
  /// It has more pixels or bytes than the options allow.
  too_large,
  /// A folder without any picture.
  empty_folder,
  /// A scene file with errors.
  bad_scene,
  /// A scene file was edited and has errors; the version before is shown.
  bad_edit,
  /// A device does not exist (any more) or delivers nothing.
  device_lost,
  /// A frame of a video or a picture of a folder cannot be read; others may be readable.
  frame_lost,
  /// A picture cannot be written.
  unwritable
};

/// Error of reading or writing pictures. what() has the file or device, the error and the remedy.
class ImageSourceError : public std::runtime_error {
public:
  ImageSourceError(ImageFault fault, std::string source, const std::string& message,
                   std::string remedy)
    : std::runtime_error(source + ": " + message + ". " + remedy), fault_(fault),
      source_(std::move(source)), remedy_(std::move(remedy)) {
    // nop
  }

  ImageFault fault() const { return fault_; }

  /// The file or device concerned.
  const std::string& source() const { return source_; }

  /// The remedy.
  const std::string& remedy() const { return remedy_; }

  /// Whether a retry may succeed without any change but plugging in a device.
  bool transient() const {
    return fault_ == ImageFault::device_lost || fault_ == ImageFault::frame_lost ||
           fault_ == ImageFault::bad_edit;
  }

private:
  ImageFault fault_;
  std::string source_;
  std::string remedy_;
};

} // namespace castor::vision
