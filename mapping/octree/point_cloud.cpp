#include "castor/mapping/octree/point_cloud.hpp"

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/mapping/planar/beams.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace castor::mapping {

PointCloud cloud_of(const LaserScan& scan, const Pose2& robot, double scanner_height) {
  auto scanner = compose(robot, scan.mount);
  PointCloud result{{scanner.x, scanner.y, scanner_height}, {}};
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    auto range = static_cast<double>(scan.ranges[i]);
    if (!std::isfinite(range) || range <= 0)
      continue;
    auto end = transform(scanner, end_of_beam(scan, i));
    result.points.push_back({end.x, end.y, scanner_height});
  }
  return result;
}

PointCloud cloud_of(std::span<const float> depths, const geometry::Camera& camera, int step) {
  auto width = static_cast<std::size_t>(camera.width);
  if (step < 1 || camera.width < 1 ||
      depths.size() != width * static_cast<std::size_t>(camera.height))
    throw std::invalid_argument("a depth image needs a depth for each pixel of its camera, and a "
                                "step of at least 1");
  PointCloud result{camera.pose.position, {}};
  auto axis = geometry::rotate(camera.pose.rotation, {0, 0, 1});
  for (int row = 0; row < camera.height; row += step)
    for (int column = 0; column < camera.width; column += step) {
      auto depth = static_cast<double>(
        depths[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)]);
      if (!std::isfinite(depth) || depth <= 0)
        continue;
      auto ray =
        geometry::viewing_ray(camera, {static_cast<double>(column), static_cast<double>(row)});
      if (!ray)
        continue;
      auto& d = ray->direction;
      auto length = depth / (d.x * axis.x + d.y * axis.y + d.z * axis.z);
      result.points.push_back(
        {ray->origin.x + length * d.x, ray->origin.y + length * d.y, ray->origin.z + length * d.z});
    }
  return result;
}

} // namespace castor::mapping
