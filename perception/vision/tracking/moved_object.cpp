#include "castor/perception/vision/tracking/moved_object.hpp"

#include "castor/perception/vision/camera/camera_model.hpp"
#include "castor/perception/vision/camera/camera_model_vectors.hpp"

namespace castor::vision {

using namespace vectors;

namespace {

Point2 foot(const ImageBox& box) {
  return {box.center.x, box.center.y + box.height / 2};
}

void shift(Point2& point, const Point2& way) {
  point.x += way.x;
  point.y += way.y;
}

} // namespace

void move_to(const ImageBox& box, const Camera& camera, ROI& roi, SceneObject& object) {
  auto from = foot(roi.box);
  auto to = foot(box);
  if (auto before = back_project(camera, from))
    if (auto after = back_project(camera, to)) {
      auto way = *after - *before;
      object.box.centroid = object.box.centroid + way;
      object.pose.position = object.pose.position + way;
      // Whoever reads the features takes the object to be there.
      if (roi.features.extent != ObjectBox{})
        roi.features.extent.centroid = roi.features.extent.centroid + way;
    }
  Point2 way{to.x - from.x, to.y - from.y};
  shift(roi.box.center, way);
  for (auto& point : roi.contour)
    shift(point, way);
}

} // namespace castor::vision
