#include "castor/planning/body/film_strip.hpp"

#include "castor/perception/vision/camera/image_source_file.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <system_error>

namespace castor::manipulation {

namespace {

constexpr int caption_height = 22; // pixels

} // namespace

void FilmStrip::add(const vision::Image& frame, const std::string& caption) {
  const auto source = vision::as_mat(frame);
  const int height = source.rows * width_ / source.cols;
  cv::Mat result(height + caption_height, width_, CV_8UC3, cv::Scalar(30, 30, 30));
  cv::resize(source, result(cv::Rect(0, 0, width_, height)), {width_, height}, 0, 0,
             cv::INTER_AREA);
  const auto text = std::to_string(frames_.size() + 1) + "  " + caption;
  cv::putText(result, text, {6, height + 15}, cv::FONT_HERSHEY_SIMPLEX, 0.4, {240, 240, 240}, 1,
              cv::LINE_AA);
  frames_.push_back(vision::to_image(result));
}

vision::Image FilmStrip::picture() const {
  if (frames_.empty())
    return {};
  const int height = static_cast<int>(frames_.front().height);
  const int count = static_cast<int>(frames_.size());
  const int columns = std::min(columns_, count);
  const int rows = (count + columns - 1) / columns;
  cv::Mat result(rows * height, columns * width_, CV_8UC3, cv::Scalar(30, 30, 30));
  for (int i = 0; i < count; ++i)
    vision::as_mat(frames_[static_cast<std::size_t>(i)])
      .copyTo(result(cv::Rect(i % columns * width_, i / columns * height, width_, height)));
  return vision::to_image(result);
}

void write_png(const vision::Image& picture, const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  vision::write_png(file, picture);
}

} // namespace castor::manipulation
