#include "castor/perception/vision/segmentation/working_picture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/opencv_bridge.hpp"

namespace castor::vision {

namespace {

/// Central differences over all channels together.
Grid<float> contrast_of(const Grid<Colour>& lab, double chroma_weight) {
  const auto weight = static_cast<float>(chroma_weight * chroma_weight);
  const int width = lab.width();
  const int height = lab.height();
  Grid<float> result(width, height);
  const auto square = [weight](const Colour& a, const Colour& b) {
    const float l = a[0] - b[0];
    const float u = a[1] - b[1];
    const float v = a[2] - b[2];
    return l * l + weight * (u * u + v * v);
  };
  for (int y = 0; y < height; ++y) {
    const int above = std::max(0, y - 1);
    const int below = std::min(height - 1, y + 1);
    for (int x = 0; x < width; ++x) {
      const int left = std::max(0, x - 1);
      const int right = std::min(width - 1, x + 1);
      result.at(x, y) = 0.5F * std::sqrt(square(lab.at(right, y), lab.at(left, y)) +
                                         square(lab.at(x, below), lab.at(x, above)));
    }
  }
  return result;
}

float median_of(const Grid<float>& values) {
  std::vector<float> sample;
  const int step = 1 + values.size() / 20000;
  for (int cell = 0; cell < values.size(); cell += step)
    sample.push_back(values[cell]);
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  return *middle;
}

} // namespace

WorkingPicture make_working_picture(const Image& image, const SegmentationOptions& options) {
  if (image.width == 0 || image.height == 0)
    throw std::invalid_argument("segment: the image has no pixels");
  cv::Mat pixels = as_mat(image);
  WorkingPicture picture;
  const int longer = std::max(pixels.cols, pixels.rows);
  if (longer > options.working_side) {
    picture.scale = static_cast<double>(options.working_side) / longer;
    cv::Mat shrunk;
    cv::resize(pixels, shrunk, cv::Size(), picture.scale, picture.scale, cv::INTER_AREA);
    pixels = shrunk;
  }
  if (pixels.channels() == 1) {
    cv::Mat coloured;
    cv::cvtColor(pixels, coloured, cv::COLOR_GRAY2BGR);
    pixels = coloured;
  }
  picture.colour = Grid<Colour>(pixels.cols, pixels.rows);
  picture.lab = Grid<Colour>(pixels.cols, pixels.rows);
  cv::Mat colour = as_mat(picture.colour);
  pixels.convertTo(colour, CV_32FC3, 1.0 / 255);
  cv::GaussianBlur(colour, colour, cv::Size(), options.smoothing, options.smoothing,
                   cv::BORDER_REPLICATE);
  cv::Mat lab = as_mat(picture.lab);
  cv::cvtColor(colour, lab, cv::COLOR_BGR2Lab);
  picture.contrast = contrast_of(picture.lab, options.chroma_weight);
  picture.flat_contrast = static_cast<float>(
    std::max(options.flat_contrast,
             options.noise_factor * static_cast<double>(median_of(picture.contrast))));
  return picture;
}

} // namespace castor::vision
