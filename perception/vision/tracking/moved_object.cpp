#include "castor/perception/vision/tracking/moved_object.hpp"

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_bridge.hpp"

namespace castor::vision {

using namespace geometry;

namespace {

Point2 foot(const ImageBox& box) {
  return {box.center.x, box.center.y + box.height / 2};
}

void shift(Point2& point, const Point2& way) {
  point.x += way.x;
  point.y += way.y;
}

void shift(Point3& point, const Eigen::Vector3d& way) {
  point = to_point(to_eigen(point) + way);
}

} // namespace

void move_to(const ImageBox& box, const Camera& camera, ROI& roi, SceneObject& object) {
  auto from = foot(roi.box);
  auto to = foot(box);
  if (auto before = back_project(camera, from))
    if (auto after = back_project(camera, to)) {
      const Eigen::Vector3d way = to_eigen(*after) - to_eigen(*before);
      shift(object.box.centroid, way);
      shift(object.pose.position, way);
      // Whoever reads the features takes the object to be there.
      if (roi.features.extent != AlignedBox{})
        shift(roi.features.extent.centroid, way);
    }
  Point2 way{to.x - from.x, to.y - from.y};
  shift(roi.box.center, way);
  for (auto& point : roi.contour)
    shift(point, way);
}

} // namespace castor::vision
