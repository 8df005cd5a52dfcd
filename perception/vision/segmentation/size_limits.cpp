#include "castor/perception/vision/segmentation/size_limits.hpp"

#include "castor/perception/vision/recognition/size_on_table.hpp"

#include <algorithm>

namespace castor::vision {

namespace {

/// What does not stand on the table has no length, and is not shorter.
bool is_shorter(const Segment& segment, const Camera& camera, double length) {
  const auto box = extent_on_table(camera, segment.contour);
  return box && std::max({box->size.x, box->size.y, box->size.z}) < length;
}

} // namespace

std::vector<Segment> segment_table(const Image& image, const Camera* camera,
                                   const SizeLimits& limits, SegmentationOptions options,
                                   const BackgroundModel* background) {
  if (limits.min_area > 0) {
    options.min_area = limits.min_area;
    options.min_pixels = 0;
    return segment(image, options, background);
  }
  if (camera == nullptr || camera->is_assumed)
    return segment(image, options, background);
  options.min_pixels = limits.min_pixels;
  auto segments = segment(image, options, background);
  std::erase_if(segments, [&](const Segment& segment) {
    return is_shorter(segment, *camera, limits.min_length);
  });
  return segments;
}

} // namespace castor::vision
