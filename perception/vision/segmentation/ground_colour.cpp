#include "castor/perception/vision/segmentation/ground_colour.hpp"

#include <algorithm>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/opencv_bridge.hpp"

namespace castor::vision {

namespace {

/// The side of the smallest block that a mean is taken over; pixels.
constexpr int block = 8;

/// Sums over blocks: three colours and the number of known pixels.
using Sums = cv::Mat_<cv::Vec4f>;

Sums sum_blocks(const Grid<Colour>& colours, const Grid<std::uint8_t>& known) {
  Sums sums((colours.height() + block - 1) / block, (colours.width() + block - 1) / block,
            cv::Vec4f::all(0));
  for (int y = 0; y < colours.height(); ++y) {
    for (int x = 0; x < colours.width(); ++x) {
      if (known.at(x, y) == 0)
        continue;
      const Colour& colour = colours.at(x, y);
      sums(y / block, x / block) += cv::Vec4f(colour[0], colour[1], colour[2], 1);
    }
  }
  return sums;
}

Sums halve(const Sums& fine) {
  Sums coarse((fine.rows + 1) / 2, (fine.cols + 1) / 2, cv::Vec4f::all(0));
  for (int y = 0; y < fine.rows; ++y) {
    for (int x = 0; x < fine.cols; ++x)
      coarse(y / 2, x / 2) += fine(y, x);
  }
  return coarse;
}

} // namespace

Grid<Colour> interpolate(const Grid<Colour>& colours, const Grid<std::uint8_t>& known) {
  std::vector<Sums> pyramid{sum_blocks(colours, known)};
  while (pyramid.back().cols > 1 || pyramid.back().rows > 1)
    pyramid.push_back(halve(pyramid.back()));
  cv::Mat_<cv::Vec3f> filled(1, 1, cv::Vec3f::all(0));
  float full = block * block;
  for (std::size_t level = 1; level < pyramid.size(); ++level)
    full *= 4;
  for (std::size_t level = pyramid.size(); level-- > 0; full /= 4) {
    const Sums& sums = pyramid[level];
    cv::Mat_<cv::Vec3f> finer;
    cv::resize(filled, finer, sums.size(), 0, 0, cv::INTER_LINEAR);
    for (int y = 0; y < sums.rows; ++y) {
      for (int x = 0; x < sums.cols; ++x) {
        const cv::Vec4f& sum = sums(y, x);
        if (sum[3] <= 0)
          continue;
        // Half full is enough to go by this block alone; at the top there is nothing else.
        const float trust = level + 1 == pyramid.size() ? 1.0F : std::min(1.0F, 2 * sum[3] / full);
        const cv::Vec3f mean(sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]);
        finer(y, x) = finer(y, x) * (1 - trust) + mean * trust;
      }
    }
    filled = finer;
  }
  Grid<Colour> result(colours.width(), colours.height());
  cv::Mat target = as_mat(result);
  cv::resize(filled, target, target.size(), 0, 0, cv::INTER_LINEAR);
  return result;
}

} // namespace castor::vision
