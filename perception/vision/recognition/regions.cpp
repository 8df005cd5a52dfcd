#include "castor/perception/vision/recognition/regions.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "castor/mapping/geometry/seen_solid.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/recognition/outline_fit.hpp"
#include "castor/perception/vision/recognition/shape_evidence.hpp"

namespace castor::vision {

namespace {

Point3 lengths_of(const std::string& shape, const std::vector<Point2>& contour,
                  const Camera& camera) {
  const bool is_solid = shape == "cube" || shape == "cylinder" || shape == "sphere";
  if (!is_solid || camera.is_assumed)
    return {};
  const auto seen = geometry::seen_solid(shape, contour, camera);
  return seen && seen->error <= geometry::good_outline_fit ? seen->solid.size : Point3{};
}

} // namespace

ROI make_roi(const Image& image, const Segment& segment) {
  const auto left = [](double centre, double length) {
    return static_cast<int>(std::lround(centre - (length - 1) / 2));
  };
  const cv::Rect box(left(segment.box.center.x, segment.box.width),
                     left(segment.box.center.y, segment.box.height),
                     static_cast<int>(std::lround(segment.box.width)),
                     static_cast<int>(std::lround(segment.box.height)));
  const cv::Mat pixels = as_mat(image);
  if ((box & cv::Rect(0, 0, pixels.cols, pixels.rows)) != box)
    throw std::invalid_argument("make_roi: the segment's box is not within the image");
  ROI roi;
  roi.box = segment.box;
  roi.region = to_image(pixels(box));
  roi.mask = segment.mask;
  roi.contour = segment.contour;
  return roi;
}

RegionFeatures measure_region(const ROI& roi, const Camera* camera, const RegionOptions& options,
                              const ShapeNetwork& network) {
  RegionFeatures features;
  features.colours = name_colour(roi.region, roi.mask, options.colour);
  features.colour_evidence = measure_colour(roi.region, roi.mask, options.colour);
  std::vector<double> fit;
  ShapeOptions shape = options.shape;
  if (camera != nullptr && !camera->is_assumed)
    fit = measure_fit(roi, *camera);
  else
    shape.tells_round_apart = false;
  features.shape_evidence = measure_shape(roi.region, roi.mask, fit);
  features.shapes = classify_shape(features.shape_evidence, shape, network);
  const auto best = best_of(features.shapes);
  const bool is_sure = best.value != Hypothesis{}.value && best.confidence >= shape.sure;
  if (!fit.empty() && !features.shape_evidence.empty() && !is_sure)
    features.shapes =
      classify_shape(features.shape_evidence, shape, network, outline_deviations(roi, *camera));
  if (camera != nullptr) {
    features.extent =
      extent_on_table(*camera, roi.contour, best_of(features.shapes).value).value_or(AlignedBox{});
    features.is_extent_assumed = camera->is_assumed;
    features.lengths = lengths_of(best_of(features.shapes).value, roi.contour, *camera);
  }
  return features;
}

Hypothesis best_of(std::span<const Hypothesis> ranked) {
  return ranked.empty() ? Hypothesis{} : ranked.front();
}

std::vector<Region> find_regions(const Image& image, const Camera* camera,
                                 const RegionOptions& options, const BackgroundModel* background,
                                 const ShapeNetwork& network) {
  std::vector<Region> regions;
  for (const auto& found : segment(image, options.segmentation, background)) {
    Region region;
    region.roi = make_roi(image, found);
    region.roi.features = measure_region(region.roi, camera, options, network);
    region.roi.has_features = true;
    region.colour = best_of(region.roi.features.colours);
    region.shape = best_of(region.roi.features.shapes);
    region.size = best_of(
      judge_size(region.roi.features.extent, region.roi.features.is_extent_assumed, options.size));
    regions.push_back(std::move(region));
  }
  return regions;
}

} // namespace castor::vision
