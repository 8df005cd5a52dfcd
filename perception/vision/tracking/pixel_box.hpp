#pragma once

#include "castor/perception/vision/types.hpp"

#include <algorithm>

#include <opencv2/core.hpp>

/// Boxes as OpenCV has them. For source files only: no public header includes OpenCV.
namespace castor::vision {

/// The pixels that the box covers, one at least; they may be beyond the picture.
inline cv::Rect pixels_of(const ImageBox& box) {
  cv::Size size(std::max(1, cvRound(box.width)), std::max(1, cvRound(box.height)));
  return {{cvRound(box.center.x - (size.width - 1) / 2.0),
           cvRound(box.center.y - (size.height - 1) / 2.0)},
          size};
}

inline ImageBox box_of(const cv::Rect& rect) {
  return {{rect.x + (rect.width - 1) / 2.0, rect.y + (rect.height - 1) / 2.0},
          static_cast<double>(rect.width),
          static_cast<double>(rect.height)};
}

} // namespace castor::vision
