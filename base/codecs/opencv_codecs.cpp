#include "castor/base/picture_codecs.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <stdexcept>

namespace castor {

namespace {

/// Empty if it cannot be decoded.
cv::Mat decoded(std::span<const std::uint8_t> file, int mode) {
  try {
    // OpenCV only reads it.
    return cv::imdecode(
      cv::Mat(1, static_cast<int>(file.size()), CV_8UC1, const_cast<std::uint8_t*>(file.data())),
      mode);
  } catch (const cv::Exception&) {
    return {};
  }
}

template <class T>
Pixels<T> pixels_of(const cv::Mat& picture) {
  Pixels<T> result{picture.cols, picture.rows, picture.channels(), {}};
  result.values.reserve(picture.total() * static_cast<std::size_t>(picture.channels()));
  for (int row = 0; row < picture.rows; ++row) {
    const auto* first = picture.ptr<T>(row);
    result.values.insert(result.values.end(), first, first + picture.cols * picture.channels());
  }
  return result;
}

Pixels<std::uint8_t> colours_of(std::span<const std::uint8_t> file) {
  const auto picture = decoded(file, cv::IMREAD_COLOR);
  return picture.type() == CV_8UC3 ? pixels_of<std::uint8_t>(picture) : Pixels<std::uint8_t>{};
}

Pixels<double> values_of(std::span<const std::uint8_t> file) {
  const auto picture = decoded(file, cv::IMREAD_UNCHANGED);
  if (picture.empty())
    return {};
  cv::Mat result;
  const double scale = picture.depth() == CV_8U ? 1. : picture.depth() == CV_16U ? 1. / 257 : 255.;
  picture.convertTo(result, CV_64F, scale);
  return pixels_of<double>(result);
}

std::vector<std::uint8_t> png_of(int width, int height, int channels,
                                 std::span<const std::uint8_t> values) {
  std::vector<std::uint8_t> result;
  try {
    cv::imencode(".png",
                 cv::Mat(height, width, CV_8UC(channels), const_cast<std::uint8_t*>(values.data())),
                 result);
  } catch (const cv::Exception& e) {
    throw std::runtime_error(e.err);
  }
  return result;
}

} // namespace

extern "C" const PictureCodecs* castor_picture_codecs() {
  static constexpr PictureCodecs result{&colours_of, &values_of, &png_of};
  return &result;
}

} // namespace castor
