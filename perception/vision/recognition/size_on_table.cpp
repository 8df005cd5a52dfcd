#include "castor/perception/vision/recognition/size_on_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_ray.hpp"

namespace castor::vision {

using namespace geometry;

using Eigen::Vector3d;

namespace {

std::optional<AlignedBox> flat_extent(const Camera& camera, std::span<const Point2> contour) {
  Eigen::AlignedBox3d box;
  for (const auto& pixel : contour) {
    const auto point = back_project(camera, pixel);
    if (!point)
      return std::nullopt;
    box.extend(to_eigen(*point));
  }
  return AlignedBox{to_point(box.center()), to_point(box.sizes()), camera.pose.frame};
}

/// Where the ray meets the upright plane through `point` with the level normal `normal`.
std::optional<Vector3d> meet(const EigenRay& ray, const Vector3d& point, const Vector3d& normal) {
  if (ray.direction().dot(normal) <= 0)
    return std::nullopt;
  return ray.intersectionPoint(Eigen::Hyperplane<double, 3>(normal, point));
}

std::optional<AlignedBox> solid_extent(const Camera& camera, std::span<const Point2> contour) {
  const auto by_x = [](const Point2& a, const Point2& b) { return a.x < b.x; };
  const auto by_y = [](const Point2& a, const Point2& b) { return a.y < b.y; };
  const auto [left, right] = std::minmax_element(contour.begin(), contour.end(), by_x);
  const auto [top, bottom] = std::minmax_element(contour.begin(), contour.end(), by_y);
  const double middle = (left->x + right->x) / 2;
  // Contours run through pixel centres; the region reaches half a pixel further.
  const auto foot = back_project(camera, {middle, bottom->y + 0.5});
  const auto top_ray = viewing_ray(camera, {middle, top->y - 0.5});
  const auto left_ray = viewing_ray(camera, {left->x - 0.5, left->y});
  const auto right_ray = viewing_ray(camera, {right->x + 0.5, right->y});
  if (!foot || !top_ray || !left_ray || !right_ray)
    return std::nullopt;
  const Vector3d away(foot->x - camera.pose.position.x, foot->y - camera.pose.position.y, 0);
  if (away.norm() <= 0)
    return std::nullopt;
  const Vector3d direction = away.normalized();
  // The widest part is half its width behind the foot; each round is nearer to what that means.
  constexpr int rounds = 4;
  double width = 0;
  Vector3d centre = to_eigen(*foot);
  for (int round = 0; round < rounds; ++round) {
    const auto left_end = meet(to_eigen(*left_ray), centre, direction);
    const auto right_end = meet(to_eigen(*right_ray), centre, direction);
    if (!left_end || !right_end)
      return std::nullopt;
    width = std::hypot(right_end->x() - left_end->x(), right_end->y() - left_end->y());
    centre = to_eigen(*foot) + (width / 2) * direction;
  }
  // The upper end of the outline is somewhere between the axis of the solid and its far side.
  const auto top_end = meet(to_eigen(*top_ray), centre + (width / 4) * direction, direction);
  const double height = top_end ? std::max(0.0, top_end->z()) : 0;
  return AlignedBox{
    {centre.x(), centre.y(), height / 2}, {width, width, height}, camera.pose.frame};
}

} // namespace

std::optional<AlignedBox> extent_on_table(const Camera& camera, std::span<const Point2> contour,
                                          bool flat) {
  if (contour.empty())
    return std::nullopt;
  return flat ? flat_extent(camera, contour) : solid_extent(camera, contour);
}

std::vector<Hypothesis> judge_size(const AlignedBox& extent, bool is_assumed,
                                   const SizeOptions& options) {
  const double longest = std::max({extent.size.x, extent.size.y, extent.size.z});
  if (longest <= 0)
    return {};
  // A logistic function of the logarithm, scaled so that it is 0.9 at the sure factor.
  const double scaled =
    std::log(9.0) * std::log(longest / options.large_from) / std::log(options.sure_factor);
  const double trust = is_assumed ? options.trust_in_assumed : 1;
  const double large = 0.5 + trust * (1 / (1 + std::exp(-scaled)) - 0.5);
  std::vector<Hypothesis> result{{"large", large}, {"small", 1 - large}};
  if (large < 0.5)
    std::swap(result[0], result[1]);
  return result;
}

} // namespace castor::vision
