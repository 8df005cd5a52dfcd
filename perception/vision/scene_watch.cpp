#include "castor/perception/vision/scene_watch.hpp"

#include "castor/perception/vision/opencv_bridge.hpp"

#include <opencv2/imgproc.hpp>

#include <utility>

namespace castor::vision {

namespace {

Image to_grey(const Image& image) {
  if (image.channels != 3 || image.bytes.empty())
    return image;
  cv::Mat grey;
  cv::cvtColor(as_mat(image), grey, cv::COLOR_BGR2GRAY);
  return to_image(grey);
}

} // namespace

std::optional<SceneChanged> SceneWatch::observe(const Image& frame) {
  auto grey = to_grey(frame);
  bool changed = last_ ? differs(grey) : options_.first_frame_counts;
  last_ = std::move(grey);
  if (changed) {
    something_happened_ = true;
    countdown_ = options_.still_frames;
  } else if (something_happened_) {
    --countdown_;
  }
  if (!something_happened_)
    return std::nullopt;
  SceneChanged result;
  if (countdown_ > 0) {
    result.changing = true;
  } else {
    something_happened_ = false;
    result.changed = true;
  }
  return result;
}

bool SceneWatch::differs(const Image& grey) const {
  if (grey.width != last_->width || grey.height != last_->height)
    return true;
  if (grey.bytes.empty())
    return false;
  cv::Mat difference;
  cv::absdiff(as_mat(grey), as_mat(*last_), difference);
  cv::Mat changed = difference > options_.pixel_threshold;
  if (cv::countNonZero(changed) > options_.changed_share * static_cast<double>(changed.total()))
    return true;
  if (options_.changed_square <= 0)
    return false;
  cv::erode(changed, changed,
            cv::Mat::ones(options_.changed_square, options_.changed_square, CV_8U));
  return cv::countNonZero(changed) > 0;
}

} // namespace castor::vision
