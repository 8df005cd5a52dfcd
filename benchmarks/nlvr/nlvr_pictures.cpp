#include "castor/benchmarks/nlvr/nlvr_pictures.hpp"

#include "castor/benchmarks/nlvr/picture_boxes.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/recognition/shape_classifier.hpp"
#include "castor/perception/vision/recognition/shape_evidence.hpp"
#include "castor/perception/vision/segmentation/region_matching.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace castor::nlvr {

namespace {

using communication::test::PicturedItem;

/// Overlap from which on two squares are the same item, intersection over union.
constexpr double same_place = 0.5;

/// Sizes that differ by less are the same; metres.
constexpr double same_size = 0.002;

vision::RegionOptions options_for_drawings() {
  vision::RegionOptions options;
  options.shape.candidates = {"circle", "square", "triangle"};
  // What touches a wall is at the border of the picture of its box.
  options.segmentation.max_border = 1;
  // A box has one ground, and large things may be in a corner of it.
  options.segmentation.ground_border = 0.5;
  return options;
}

/// Drawings have neither light nor shade: the outline alone tells the shape.
std::string shape_of(const vision::ROI& roi, const vision::ShapeOptions& options) {
  auto plain = roi.region;
  std::ranges::fill(plain.bytes, std::uint8_t{128});
  return vision::best_of(vision::classify_shape(vision::measure_shape(plain, roi.mask), options))
    .value;
}

/// \param side of the picture of the box, pixels
PicturedItem seen_item(const vision::Region& region, double side,
                       const vision::ShapeOptions& shape) {
  const double pixel = box_side / side;
  const auto box = vision::pixels_of(region.roi.box);
  const double size = std::max(box.width, box.height);
  return {shape_of(region.roi, shape), region.colour.value, box.x * pixel,
          (side - box.y - box.height) * pixel, size * pixel};
}

Items see_items(const cv::Mat& box, const vision::RegionOptions& options) {
  // Objects are divided by gaps of a few pixels at least.
  const double scale =
    std::max(1.0, std::floor(static_cast<double>(options.segmentation.working_side) /
                             std::max(box.cols, box.rows)));
  cv::Mat magnified;
  cv::resize(box, magnified, {}, scale, scale, cv::INTER_NEAREST);
  Items result;
  for (auto& region : vision::find_regions(vision::to_image(magnified), nullptr, options))
    result.push_back(seen_item(region, magnified.rows, options.shape));
  return result;
}

/// Intersection over union of two squares.
double overlap(const PicturedItem& a, const PicturedItem& b) {
  return vision::overlap({{a.x + a.size / 2, a.z + a.size / 2}, a.size, a.size},
                         {{b.x + b.size / 2, b.z + b.size / 2}, b.size, b.size});
}

} // namespace

std::vector<Items> see_boxes(const vision::Image& picture) {
  const auto options = options_for_drawings();
  const auto pixels = vision::as_mat(picture);
  std::vector<Items> result;
  for (auto& box : find_picture_boxes(picture))
    result.push_back(see_items(pixels(vision::pixels_of(box)), options));
  return result;
}

void compare(const std::vector<Items>& drawn, const std::vector<Items>& seen, Agreement& total) {
  const auto before = total;
  for (auto& box : drawn)
    total.drawn += box.size();
  for (auto& box : seen)
    total.seen += box.size();
  for (std::size_t i = 0; i < std::min(drawn.size(), seen.size()); ++i) {
    auto left = seen[i];
    for (auto& item : drawn[i]) {
      auto best = std::ranges::max_element(left, {}, [&](auto& x) { return overlap(x, item); });
      if (best == left.end() || overlap(*best, item) < same_place)
        continue;
      ++total.found;
      total.same_colour += best->colour == item.colour ? 1 : 0;
      total.same_shape += best->shape == item.shape ? 1 : 0;
      total.same_size += std::abs(best->size - item.size) <= same_size ? 1 : 0;
      left.erase(best);
    }
  }
  const auto items = total.drawn - before.drawn;
  ++total.pictures;
  const bool is_same =
    drawn.size() == seen.size() && total.seen - before.seen == items &&
    total.found - before.found == items && total.same_colour - before.same_colour == items &&
    total.same_shape - before.same_shape == items && total.same_size - before.same_size == items;
  total.same_pictures += is_same ? 1 : 0;
}

} // namespace castor::nlvr
