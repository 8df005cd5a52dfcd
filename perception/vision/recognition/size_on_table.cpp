#include "castor/perception/vision/recognition/size_on_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_ray.hpp"

namespace castor::vision {

using namespace geometry;

using Eigen::Vector3d;

namespace {

bool lies_flat(const std::string& shape) {
  constexpr std::array flat{"square", "rectangle", "triangle", "circle"};
  return std::ranges::find(flat, shape) != flat.end();
}

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

/// The direction in the picture in which what is on the table is further away from the camera
/// there, of length 1; upwards where the camera looks straight down.
Eigen::Vector2d away_in_picture(const Camera& camera, std::span<const Point2> contour) {
  const Eigen::Vector2d upwards(0, -1);
  Eigen::Vector2d middle(0, 0);
  for (const auto& pixel : contour)
    middle += Eigen::Vector2d(pixel.x, pixel.y) / static_cast<double>(contour.size());
  const auto ground = back_project(camera, {middle.x(), middle.y()});
  if (!ground)
    return upwards;
  const Eigen::Vector2d away(ground->x - camera.pose.position.x,
                             ground->y - camera.pose.position.y);
  if (away.norm() <= 0)
    return upwards;
  constexpr double step = 0.01; // metres
  const Eigen::Vector2d further = step * away.normalized();
  const auto pixel = project(camera, {ground->x + further.x(), ground->y + further.y(), 0});
  if (!pixel)
    return upwards;
  const Eigen::Vector2d way(pixel->x - middle.x(), pixel->y - middle.y());
  return way.norm() > 0 ? Eigen::Vector2d(way.normalized()) : upwards;
}

/// The ends of a solid's outline, as if the picture were turned such that its far side is up.
struct OutlineEnds {
  /// Of the lowest ray on the table.
  Vector3d foot;
  EigenRay bottom;
  EigenRay top;
  EigenRay left;
  EigenRay right;
  /// Level, away from the camera, of length 1.
  Vector3d away;
};

std::optional<OutlineEnds> ends_of(const Camera& camera, std::span<const Point2> contour) {
  const auto up = away_in_picture(camera, contour);
  const Eigen::Vector2d right(-up.y(), up.x());
  const auto height_of = [&](const Point2& x) { return up.x() * x.x + up.y() * x.y; };
  const auto column_of = [&](const Point2& x) { return right.x() * x.x + right.y() * x.y; };
  const auto pixel = [&](double column, double height) {
    const Eigen::Vector2d result = column * right + height * up;
    return Point2{result.x(), result.y()};
  };
  const auto [first, last] = std::ranges::minmax_element(contour, {}, column_of);
  const auto [bottom, top] = std::ranges::minmax(contour, {}, height_of);
  const double middle = (column_of(*first) + column_of(*last)) / 2;
  // Contours run through pixel centres; the region reaches half a pixel further.
  const auto bottom_pixel = pixel(middle, height_of(bottom) - 0.5);
  const auto foot = back_project(camera, bottom_pixel);
  const auto bottom_ray = viewing_ray(camera, bottom_pixel);
  const auto top_ray = viewing_ray(camera, pixel(middle, height_of(top) + 0.5));
  const auto left_ray = viewing_ray(camera, pixel(column_of(*first) - 0.5, height_of(*first)));
  const auto right_ray = viewing_ray(camera, pixel(column_of(*last) + 0.5, height_of(*last)));
  if (!foot || !bottom_ray || !top_ray || !left_ray || !right_ray)
    return std::nullopt;
  const Vector3d away(foot->x - camera.pose.position.x, foot->y - camera.pose.position.y, 0);
  if (away.norm() <= 0)
    return std::nullopt;
  return OutlineEnds{to_eigen(*foot),     to_eigen(*bottom_ray), to_eigen(*top_ray),
                     to_eigen(*left_ray), to_eigen(*right_ray),  away.normalized()};
}

/// Its middle is between the highest and the lowest ray, as high as it is wide.
std::optional<AlignedBox> ball_extent(const Camera& camera, const OutlineEnds& ends) {
  const Vector3d top = ends.top.direction().normalized();
  const Vector3d bottom = ends.bottom.direction().normalized();
  const Vector3d middle = (top + bottom).normalized();
  const double sine = std::sqrt(std::max(0.0, (1 - top.dot(bottom)) / 2));
  // Its radius, and height, is this share of its distance.
  const double distance = ends.top.origin().z() / (sine - middle.z());
  if (!(distance > 0))
    return std::nullopt;
  const Vector3d centre = ends.top.origin() + distance * middle;
  const double width = 2 * distance * sine;
  return AlignedBox{to_point(centre), {width, width, width}, camera.pose.frame};
}

std::optional<AlignedBox> solid_extent(const Camera& camera, std::span<const Point2> contour,
                                       const std::string& shape) {
  const auto ends = ends_of(camera, contour);
  if (!ends)
    return std::nullopt;
  if (shape == "sphere")
    return ball_extent(camera, *ends);
  const auto& direction = ends->away;
  // The widest part is half its width behind the foot; each round is nearer to what that means.
  constexpr int rounds = 4;
  double width = 0;
  Vector3d centre = ends->foot;
  for (int round = 0; round < rounds; ++round) {
    const auto left_end = meet(ends->left, centre, direction);
    const auto right_end = meet(ends->right, centre, direction);
    if (!left_end || !right_end)
      return std::nullopt;
    width = std::hypot(right_end->x() - left_end->x(), right_end->y() - left_end->y());
    centre = ends->foot + (width / 2) * direction;
  }
  const auto height_at = [&](double beyond) {
    const auto end = meet(ends->top, centre + beyond * direction, direction);
    return end ? std::max(0.0, end->z()) : 0;
  };
  // From above, the upper end of the outline of what is upright is the far side of its top, else
  // the near side. Of other shapes it is somewhere between the axis and the far side.
  double height = height_at(width / 4);
  if (shape == "cylinder" || shape == "cube") {
    height = height_at(width / 2);
    if (height > camera.pose.position.z)
      height = height_at(-width / 2);
  }
  return AlignedBox{
    {centre.x(), centre.y(), height / 2}, {width, width, height}, camera.pose.frame};
}

} // namespace

std::optional<AlignedBox> extent_on_table(const Camera& camera, std::span<const Point2> contour,
                                          const std::string& shape) {
  if (contour.empty())
    return std::nullopt;
  return lies_flat(shape) ? flat_extent(camera, contour) : solid_extent(camera, contour, shape);
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
