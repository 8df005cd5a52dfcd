#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <system_error>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "castor/base/input_file.hpp"
#include "castor/perception/vision/camera/image_source_kinds.hpp"
#include "castor/perception/vision/camera/video_sources.hpp"

namespace castor::vision {

namespace {

/// OpenCV tells of each of the several ways in which it tries to open a video, on the standard
/// error stream; what matters of that is in our own exceptions.
void silence_opencv() {
  static std::once_flag done;
  std::call_once(done, [] {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    // Read by OpenCV when it first opens a video; -8 is FFmpeg's AV_LOG_QUIET.
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  });
}

/// In 8-bit B, G, R, whatever the capture delivers; nothing if it is no picture.
std::optional<Image> image_of_frame(const cv::Mat& frame) {
  cv::Mat pixels = frame;
  if (pixels.empty() || pixels.dims != 2)
    return std::nullopt;
  if (pixels.depth() == CV_16U)
    pixels.convertTo(pixels, CV_8U, 1 / 256.0);
  if (pixels.depth() != CV_8U)
    return std::nullopt;
  if (pixels.channels() == 1)
    cv::cvtColor(pixels, pixels, cv::COLOR_GRAY2BGR);
  else if (pixels.channels() == 4)
    cv::cvtColor(pixels, pixels, cv::COLOR_BGRA2BGR);
  else if (pixels.channels() != 3)
    return std::nullopt;
  Image image;
  image.width = static_cast<std::uint32_t>(pixels.cols);
  image.height = static_cast<std::uint32_t>(pixels.rows);
  image.bytes.reserve(pixels.total() * 3);
  for (int row = 0; row < pixels.rows; ++row)
    image.bytes.insert(image.bytes.end(), pixels.ptr(row), pixels.ptr(row) + 3 * pixels.cols);
  return image;
}

std::optional<Image> read_frame(cv::VideoCapture& capture) {
  try {
    cv::Mat frame;
    if (!capture.read(frame))
      return std::nullopt;
    return image_of_frame(frame);
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

Camera camera_of(cv::VideoCapture& capture, const ImageSourceOptions& options) {
  const auto width = static_cast<int>(capture.get(cv::CAP_PROP_FRAME_WIDTH));
  const auto height = static_cast<int>(capture.get(cv::CAP_PROP_FRAME_HEIGHT));
  return camera_for(options, std::max(width, 1), std::max(height, 1));
}

class VideoSource : public ImageSource {
public:
  VideoSource(const std::filesystem::path& path, const ImageSourceOptions& options)
    : options_(options), path_(path) {
    silence_opencv();
    open();
    const double pixels =
      capture_.get(cv::CAP_PROP_FRAME_WIDTH) * capture_.get(cv::CAP_PROP_FRAME_HEIGHT);
    if (pixels > static_cast<double>(options.limits.max_pixels))
      throw ImageSourceError(ImageFault::too_large, path.string(),
                             "the video's pictures have more pixels than the limit of " +
                               std::to_string(options.limits.max_pixels),
                             "Scale it down or raise the limit.");
    camera_ = camera_of(capture_, options_);
    // A file that opens but has not one frame is better refused now than later.
    pending_ = read_frame(capture_);
    if (!pending_)
      throw ImageSourceError(ImageFault::truncated, path.string(),
                             "not even the first picture of the video can be read",
                             "Check that it plays elsewhere, or convert it.");
  }

  Frame next() override {
    if (!pending_)
      advance();
    if (pending_) {
      last_ = std::move(*pending_);
      pending_.reset();
      ++position_;
      failures_ = 0;
      camera_ = camera_for(options_, static_cast<int>(last_.width), static_cast<int>(last_.height));
      return {last_, options_.clock(), count_++, true};
    }
    return {last_, options_.clock(), count_++, false};
  }

  Camera camera() const override { return camera_; }

  std::string description() const override { return "video " + path_.string(); }

private:
  /// How often in a row a frame may be lost before it is taken for the end.
  static constexpr int max_failures = 5;

  void open() {
    try {
      require_input_file(path_);
    } catch (const InputFileError& e) {
      if (e.reason() == InputFileError::Reason::missing)
        throw ImageSourceError(ImageFault::not_found, path_.string(), "the video is gone",
                               "Check the folder it was in.");
      throw ImageSourceError(ImageFault::unreadable, path_.string(),
                             std::string{"the video cannot be read ("} + e.what() + ")",
                             "Check that it is a file, and that you may read it.");
    }
    bool opened = false;
    try {
      opened = capture_.open(path_.string());
    } catch (const cv::Exception&) {
      opened = false;
    }
    if (!opened)
      throw ImageSourceError(ImageFault::not_an_image, path_.string(),
                             "this is no video that can be decoded here",
                             "Check that it plays elsewhere, or convert it to AVI or MP4.");
    position_ = 0;
  }

  /// Reads into pending_; leaves it empty at the end, if the last picture is to be held.
  void advance() {
    if (ended_)
      return;
    pending_ = read_frame(capture_);
    if (pending_)
      return;
    // Containers know their length only roughly: a loss shortly before the end is the end.
    const double length = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    const bool early = length > 0 && static_cast<double>(position_) < 0.95 * length - 2;
    if (early && ++failures_ < max_failures)
      throw ImageSourceError(ImageFault::frame_lost, path_.string(),
                             "picture " + std::to_string(position_ + 1) +
                               " of the video cannot be read",
                             "The next attempt continues after it.");
    failures_ = 0;
    if (options_.at_end == ImageSourceOptions::AtEnd::hold_last) {
      ended_ = true;
      return;
    }
    capture_.release();
    open();
    pending_ = read_frame(capture_);
    if (!pending_)
      throw ImageSourceError(ImageFault::truncated, path_.string(),
                             "the video cannot be read again from its beginning",
                             "Check that it plays elsewhere, or convert it.");
  }

  ImageSourceOptions options_;
  std::filesystem::path path_;
  cv::VideoCapture capture_;
  Camera camera_;
  std::optional<Image> pending_;
  Image last_;
  bool ended_ = false;
  int failures_ = 0;
  /// How many pictures were read since the beginning of the file.
  std::uint64_t position_ = 0;
  std::uint64_t count_ = 0;
};

class DeviceSource : public ImageSource {
public:
  DeviceSource(const std::filesystem::path& path, const ImageSourceOptions& options)
    : options_(options), path_(path),
      camera_(camera_for(options, options.device_width, options.device_height)) {
    silence_opencv();
    open();
  }

  Frame next() override {
    if (!capture_.isOpened())
      open();
    auto image = read_frame(capture_);
    if (!image) {
      // It is opened anew with the next call: it may have been unplugged in between.
      capture_.release();
      throw ImageSourceError(ImageFault::device_lost, path_.string(),
                             "the camera delivers no picture",
                             "Check its cable, and that no other program uses it.");
    }
    camera_ = camera_for(options_, static_cast<int>(image->width), static_cast<int>(image->height));
    return {std::move(*image), options_.clock(), count_++, true};
  }

  Camera camera() const override { return camera_; }

  std::string description() const override { return "camera " + path_.string(); }

private:
  void open() {
    std::error_code ignored;
    if (!std::filesystem::exists(path_, ignored))
      throw ImageSourceError(ImageFault::device_lost, path_.string(), "there is no such camera",
                             "Plug it in, or see which /dev/video* there are.");
    if (!std::filesystem::is_character_file(path_, ignored))
      throw ImageSourceError(ImageFault::unknown_kind, path_.string(), "this is not a camera",
                             "Cameras are called /dev/video0, /dev/video1, ...");
    bool opened = false;
    try {
      opened = capture_.open(path_.string(), cv::CAP_V4L2);
    } catch (const cv::Exception&) {
      opened = false;
    }
    if (!opened)
      throw ImageSourceError(
        ImageFault::device_lost, path_.string(), "the camera cannot be opened",
        "Check that you may use it (group \"video\"), and that no other program "
        "does.");
    capture_.set(cv::CAP_PROP_FRAME_WIDTH, options_.device_width);
    capture_.set(cv::CAP_PROP_FRAME_HEIGHT, options_.device_height);
  }

  ImageSourceOptions options_;
  std::filesystem::path path_;
  cv::VideoCapture capture_;
  Camera camera_;
  std::uint64_t count_ = 0;
};

std::unique_ptr<ImageSource> open_video(const std::filesystem::path& path,
                                        const ImageSourceOptions& options) {
  return std::make_unique<VideoSource>(path, options);
}

std::unique_ptr<ImageSource> open_device(const std::filesystem::path& path,
                                         const ImageSourceOptions& options) {
  return std::make_unique<DeviceSource>(path, options);
}

} // namespace

extern "C" const VideoSources* castor_video_sources() {
  static constexpr VideoSources result{&open_video, &open_device};
  return &result;
}

} // namespace castor::vision
