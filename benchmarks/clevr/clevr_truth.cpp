#include "castor/benchmarks/clevr/clevr_truth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_bridge.hpp"

namespace castor::clevr {

using Eigen::Vector3d;

namespace {

/// Points whose convex hull is the object around its own middle, for a unit radius.
std::vector<Vector3d> body(const Object& object) {
  constexpr int turns = 48;
  constexpr double step = 2 * std::numbers::pi / turns;
  std::vector<Vector3d> points;
  if (object.shape == "cube") {
    const Eigen::AngleAxisd rotation(object.rotation, Vector3d::UnitZ());
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0})
          points.push_back(rotation * Vector3d(x, y, z));
  } else if (object.shape == "cylinder") {
    for (int i = 0; i < turns; ++i) {
      for (const double z : {-1.0, 1.0})
        points.emplace_back(std::cos(i * step), std::sin(i * step), z);
    }
  } else {
    for (int i = 0; i < turns; ++i) {
      for (int j = 0; j <= turns / 2; ++j)
        points.emplace_back(std::cos(i * step) * std::sin(j * step),
                            std::sin(i * step) * std::sin(j * step), std::cos(j * step));
    }
  }
  return points;
}

} // namespace

cv::Mat_<int> visible_objects(const Scene& scene, const geometry::Camera& camera, cv::Size size) {
  // Points of polygons are counted in 16ths of a pixel.
  constexpr int shift = 4;
  cv::Mat_<int> labels(size, -1);
  std::vector<std::size_t> order(scene.objects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // The nearest is painted last.
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return scene.objects[a].distance > scene.objects[b].distance;
  });
  for (const std::size_t index : order) {
    const Object& object = scene.objects[index];
    std::vector<cv::Point> points;
    for (const auto& point : body(object)) {
      const Vector3d position = to_eigen(object.position) + object.radius() * point;
      const auto pixel = project(camera, geometry::to_point(position));
      if (pixel)
        points.emplace_back(cvRound(pixel->x * (1 << shift)), cvRound(pixel->y * (1 << shift)));
    }
    if (points.empty())
      continue;
    std::vector<cv::Point> outline;
    cv::convexHull(points, outline);
    cv::fillConvexPoly(labels, outline, cv::Scalar(static_cast<int>(index)), cv::LINE_8, shift);
  }
  return labels;
}

} // namespace castor::clevr
