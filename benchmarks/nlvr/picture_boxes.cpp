#include "castor/benchmarks/nlvr/picture_boxes.hpp"

#include "castor/perception/vision/opencv_bridge.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <tuple>

namespace castor::nlvr {

namespace {

/// Areas are large from this share of the picture on.
constexpr double large_area = 0.05;

/// Neighbouring pixels are of one area if no channel differs by more; grey levels of 255.
constexpr double same_colour = 8;

struct Area {
  cv::Rect box;
  cv::Vec3b colour;
};

/// The areas of one colour, by flooding.
std::vector<Area> areas_in(const cv::Mat& picture) {
  cv::Mat1b known(picture.rows + 2, picture.cols + 2, std::uint8_t{0});
  cv::Mat pixels = picture.clone();
  const auto tolerance = cv::Scalar::all(same_colour);
  std::vector<Area> result;
  for (int y = 0; y < pixels.rows; ++y)
    for (int x = 0; x < pixels.cols; ++x)
      if (known(y + 1, x + 1) == 0) {
        Area area;
        area.colour = pixels.at<cv::Vec3b>(y, x);
        cv::floodFill(pixels, known, {x, y}, {}, &area.box, tolerance, tolerance,
                      4 | cv::FLOODFILL_MASK_ONLY);
        result.push_back(area);
      }
  return result;
}

bool is_like(const cv::Vec3b& a, const cv::Vec3b& b) {
  return cv::norm(a, b, cv::NORM_INF) <= same_colour;
}

} // namespace

std::vector<vision::ImageBox> find_picture_boxes(const vision::Image& picture) {
  if (picture.channels != 3 || picture.bytes.empty())
    throw std::invalid_argument{"find_picture_boxes: the picture needs pixels of three channels"};
  std::vector<Area> large;
  std::vector<Area> small;
  for (auto& area : areas_in(vision::as_mat(picture))) {
    const auto share =
      static_cast<double>(area.box.area()) / (static_cast<double>(picture.width) * picture.height);
    (share >= large_area ? large : small).push_back(area);
  }
  auto holds_something = [&](const Area& x) {
    return std::ranges::any_of(small, [&](auto& y) { return (x.box & y.box) == y.box; });
  };
  auto is_box = [&](const Area& x) {
    return std::ranges::any_of(
      large, [&](auto& y) { return is_like(x.colour, y.colour) && holds_something(y); });
  };
  std::vector<vision::ImageBox> result;
  for (auto& x : large)
    if (is_box(x))
      result.push_back(vision::box_of(x.box));
  std::ranges::sort(result, {}, [](auto& x) { return std::tuple{x.center.x, x.center.y}; });
  return result;
}

} // namespace castor::nlvr
