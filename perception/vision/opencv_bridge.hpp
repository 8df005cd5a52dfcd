#pragma once

#include <algorithm>
#include <stdexcept>

#include <opencv2/core.hpp>

#include "castor/perception/vision/segmentation/grid.hpp"
#include "castor/perception/vision/types.hpp"

/// Views of our images as OpenCV matrices, without copying. For source files only: no public header
/// includes OpenCV.
namespace castor::vision {

/// A matrix over the image's own bytes; valid until the image is moved, changed or destroyed.
/// \throws std::invalid_argument unless there are 1 or 3 channels, and the bytes fit the size.
inline cv::Mat as_mat(Image& image) {
  const auto expected = static_cast<std::size_t>(image.width) * image.height * image.channels;
  if ((image.channels != 1 && image.channels != 3) || image.bytes.size() != expected)
    throw std::invalid_argument("an image needs 1 or 3 channels and width * height * channels "
                                "bytes");
  return {static_cast<int>(image.height), static_cast<int>(image.width),
          image.channels == 3 ? CV_8UC3 : CV_8UC1, image.bytes.data()};
}

/// As above, read-only.
inline const cv::Mat as_mat(const Image& image) {
  return as_mat(const_cast<Image&>(image)); // cv::Mat knows no constant pixels
}

inline cv::Mat as_mat(Grid<float>& grid) {
  return {grid.height(), grid.width(), CV_32F, grid.data()};
}

inline cv::Mat as_mat(Grid<Colour>& grid) {
  return {grid.height(), grid.width(), CV_32FC3, grid.data()};
}

/// An image of the matrix's pixels: 8 bits, 1 or 3 channels.
inline Image to_image(const cv::Mat& mat) {
  Image image{static_cast<std::uint32_t>(mat.cols),
              static_cast<std::uint32_t>(mat.rows),
              static_cast<std::uint32_t>(mat.channels()),
              {}};
  image.bytes.resize(mat.total() * mat.elemSize());
  mat.copyTo(as_mat(image));
  return image;
}

/// The pixels that the box covers, at least one; they may be outside of the picture.
inline cv::Rect pixels_of(const ImageBox& box) {
  cv::Size size(std::max(1, cvRound(box.width)), std::max(1, cvRound(box.height)));
  return {{cvRound(box.center.x - (size.width - 1) / 2.0),
           cvRound(box.center.y - (size.height - 1) / 2.0)},
          size};
}

/// The box that covers these pixels.
inline ImageBox box_of(const cv::Rect& rect) {
  return {{rect.x + (rect.width - 1) / 2.0, rect.y + (rect.height - 1) / 2.0},
          static_cast<double>(rect.width),
          static_cast<double>(rect.height)};
}

} // namespace castor::vision
