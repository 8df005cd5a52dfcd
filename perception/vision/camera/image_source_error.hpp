#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace castor::vision {

/// Why there is no picture.
enum class ImageFault {
  /// Neither a file, a folder, a device nor a kind of source is called so.
  not_found,
  unknown_kind,
  /// It is there, but may not be read, or reading it fails.
  unreadable,
  /// It is no picture or video in a format that is known here.
  not_an_image,
  /// It begins as a picture but ends early, or is damaged in between.
  truncated,
  /// It has more pixels or bytes than the options allow.
  too_large,
  /// A folder without any picture.
  empty_folder,
  /// A scene file with errors.
  bad_scene,
  /// A scene file that was edited and has errors since; it is shown as it was.
  bad_edit,
  /// A device that is not there (any more) or delivers nothing.
  device_lost,
  /// A frame of a video or a picture of a folder could not be read; others may be fine.
  frame_lost,
  /// A picture could not be written.
  unwritable
};

/// Thrown by everything that reads or writes pictures. what() says what happened, to which file or
/// device, and what to do about it.
class ImageSourceError : public std::runtime_error {
public:
  ImageSourceError(ImageFault fault, std::string source, const std::string& message,
                   std::string remedy)
    : std::runtime_error(source + ": " + message + ". " + remedy), fault_(fault),
      source_(std::move(source)), remedy_(std::move(remedy)) {
    // nop
  }

  ImageFault fault() const { return fault_; }

  /// The file or device that it is about.
  const std::string& source() const { return source_; }

  /// What to do about it.
  const std::string& remedy() const { return remedy_; }

  /// Whether it makes sense to try the same again soon, without anybody repairing anything but a
  /// plug.
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
