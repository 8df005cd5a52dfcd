#include "castor/mapping/body/scene_camera.hpp"

#include "castor/mapping/building/scene_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace castor::mapping {

namespace {

constexpr double person_height = 1.75; // metres
constexpr double tile = 0.5;           // metres, of the floor
constexpr double brick = 0.6;          // metres, of the pattern on walls

/// Blue, green, red.
using Pixel = std::array<double, 3>;

Pixel pixel(const Colour& x, double light) {
  return {x.blue * light, x.green * light, x.red * light};
}

bool is_odd(double x, double size) {
  return std::fmod(std::floor(x / size), 2) != 0;
}

/// With a texture that does not move with the camera, so that things have edges to follow.
Pixel appearance(const SceneHit& hit, std::span<const Solid> solids, const Point2& place) {
  constexpr Colour floor{150, 150, 155};
  constexpr Colour ceiling{235, 235, 235};
  if (!hit.solid) {
    if (hit.face == SolidFace::bottom)
      return pixel(ceiling, 1);
    return pixel(floor, is_odd(place.x, tile) != is_odd(place.y, tile) ? 1 : 0.88);
  }
  const auto& solid = solids[*hit.solid];
  const auto own = transform(inverse(solid.pose), place);
  double light = hit.face == SolidFace::top ? 1 : hit.face == SolidFace::bottom ? 0.5 : 0.85;
  if (hit.face == SolidFace::side && solid.shape == SolidShape::box) {
    const bool is_end = std::abs(std::abs(own.x) - solid.length / 2) < 1e-6;
    light = is_end ? 0.72 : 0.88;
    const double along = is_end ? own.y : own.x;
    light *= is_odd(along, brick) != is_odd(hit.height, brick) ? 1 : 0.94;
  } else if (hit.face == SolidFace::side) {
    // Round: lighter on one side.
    light = 0.75 + 0.2 * std::cos(std::atan2(own.y, own.x) - 0.8);
    light *= is_odd(hit.height, solid.top / 3 + 1e-3) ? 0.92 : 1;
  }
  return pixel(solid.colour, light);
}

} // namespace

SceneCamera::SceneCamera(const CameraOptions& options, std::uint64_t seed)
  : options_(options), noise_(seed) {
  if (options.width < 1 || options.height < 1 || options.width > 4096 || options.height > 4096 ||
      !(options.horizontal_fov > 0) || !(options.horizontal_fov < 180) ||
      !(options.max_range > 0) || !(options.above > 0))
    throw std::invalid_argument("a camera has a size of 1 to 4096 pixels, an angle of less than "
                                "180 degrees, a positive range, and is above the floor");
}

double SceneCamera::focal_length() const {
  return options_.width / 2.0 / std::tan(options_.horizontal_fov * std::numbers::pi / 360);
}

double SceneCamera::left_of(int column) const {
  return ((options_.width - 1) / 2.0 - column) / focal_length();
}

double SceneCamera::up_of(int row) const {
  return ((options_.height - 1) / 2.0 - row) / focal_length();
}

SceneView SceneCamera::look(std::span<const Solid> solids, std::span<const Disc> people,
                            double ceiling, const Pose2& robot) {
  std::vector<Solid> all(solids.begin(), solids.end());
  for (const auto& person : people)
    all.push_back({SolidShape::disc,
                   {person.centre.x, person.centre.y, 0},
                   2 * person.radius,
                   2 * person.radius,
                   0,
                   person_height,
                   {60, 90, 160}});
  const auto eye = transform(robot, Point2{options_.ahead, 0});
  const auto pixels =
    static_cast<std::size_t>(options_.width) * static_cast<std::size_t>(options_.height);
  SceneView view{std::vector<std::uint8_t>(3 * pixels), std::vector<float>(pixels)};
  for (int column = 0; column < options_.width; ++column) {
    const double left = left_of(column);
    const double direction = robot.heading + std::atan(left);
    // Metres along the floor for each metre along the camera's axis.
    const double stretch = std::sqrt(1 + left * left);
    // Far things are seen even if their depth is not measured.
    constexpr double horizon = 100;
    const SceneSlice slice(all, eye, direction, horizon, ceiling);
    for (int row = 0; row < options_.height; ++row) {
      const auto hit = slice.first(options_.above, up_of(row) / stretch);
      const auto i = static_cast<std::size_t>(row * options_.width + column);
      Pixel seen{200, 200, 200};
      if (hit) {
        seen = appearance(
          *hit, all,
          {eye.x + hit->along * std::cos(direction), eye.y + hit->along * std::sin(direction)});
        const double depth = hit->along / stretch;
        if (depth <= options_.max_range)
          view.depths[i] = static_cast<float>(
            std::max(0.01, depth + noise_.gaussian(options_.depth_noise * depth * depth)));
      }
      for (std::size_t channel = 0; channel < 3; ++channel)
        view.colours[3 * i + channel] = static_cast<std::uint8_t>(std::clamp(
          std::lround(seen[channel] + noise_.gaussian(options_.colour_noise)), 0L, 255L));
    }
  }
  return view;
}

geometry::Camera SceneCamera::model() const {
  geometry::Camera result;
  result.width = options_.width;
  result.height = options_.height;
  result.fx = result.fy = focal_length();
  result.cx = (options_.width - 1) / 2.0;
  result.cy = (options_.height - 1) / 2.0;
  // Its x axis is the robot's -y, its y axis the robot's -z, and its z axis the robot's x.
  result.pose = {{options_.ahead, 0, options_.above}, {0.5, -0.5, 0.5, -0.5}, geometry::base_frame};
  return result;
}

std::vector<float> SceneCamera::points_of(const SceneView& view) const {
  std::vector<float> result;
  for (int row = 0; row < options_.height; ++row)
    for (int column = 0; column < options_.width; ++column) {
      const double depth = view.depths[static_cast<std::size_t>(row * options_.width + column)];
      if (!(depth > 0))
        continue;
      result.push_back(static_cast<float>(options_.ahead + depth));
      result.push_back(static_cast<float>(depth * left_of(column)));
      result.push_back(static_cast<float>(options_.above + depth * up_of(row)));
    }
  return result;
}

} // namespace castor::mapping
