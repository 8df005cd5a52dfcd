#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_ray.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer_body.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer_bounds.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer_light.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer_table.hpp"

namespace castor::vision {

using namespace geometry;

using Eigen::Vector3d;

namespace {

constexpr double table_thickness = 0.03; // metres
constexpr double floor_z = -0.75;        // metres
constexpr double shininess = 45;         // exponent of the highlight
constexpr LinearColour floor_reflectance{0.16, 0.15, 0.15};
constexpr LinearColour wall_light{0.24, 0.24, 0.25};
/// How far from an object it keeps light off, in radii.
constexpr double sky_reach = 5;
/// How unlike two neighbouring pixels are between which there is an edge to be smoothed.
constexpr double edge_contrast = 0.04;

/// Surfaces are told apart by numbers: these two, then several for each object.
constexpr int room_surface = 0;
constexpr int table_surface = 1;
constexpr int surfaces_per_object = 8;

/// The radius of the sphere that stands for a body where it keeps light from all around off the
/// table.
double sky_radius(const Body& body) {
  return std::max(0.0, std::min(body.radius(), 1.5 * body.centre().z()));
}

/// Where that matters.
TablePatch sky_patch(const Body& body) {
  const double reach = sky_reach * sky_radius(body);
  const auto& centre = body.centre();
  return {centre.x() - reach, centre.x() + reach, centre.y() - reach, centre.y() + reach};
}

struct SceneBody {
  Body body;
  LinearColour reflectance;
  PixelWindow window;
  TablePatch shadow;
  TablePatch sky;
};

/// What a ray meets first.
struct Sight {
  int surface = room_surface;
  double distance = std::numeric_limits<double>::infinity();
  Vector3d normal = Vector3d::Zero();
  /// The object, or -1.
  int object = -1;
};

struct Sample {
  LinearColour light;
  int surface = room_surface;
};

class Stage {
public:
  Stage(const TabletopSnapshot& scene, const Camera& camera, const RenderOptions& options)
    : camera_(camera), options_(options),
      slab_(Vector3d(0, 0, -table_thickness / 2),
            Vector3d(scene.table.width, scene.table.depth, table_thickness)),
      inner_half_width_(scene.table.width / 2 - table_thickness),
      inner_half_depth_(scene.table.depth / 2 - table_thickness), texture_(scene.table),
      lamp_(to_eigen(scene.light)), lamp_distance_(lamp_.norm()), pixel_angle_(1 / camera.fy) {
    for (const auto& object : scene.objects) {
      const Body body(object);
      bodies_.push_back({body, to_linear(object.colour), window_of(body, camera),
                         shadow_patch(object, lamp_, options.lamp_radius), sky_patch(body)});
    }
    for (const auto& [object, pose] : scene.placed) {
      const Body body(object, pose);
      bodies_.push_back({body, to_linear(object.colour), window_of(body, camera),
                         shadow_patch(body, lamp_, options.lamp_radius), sky_patch(body)});
    }
    for (const auto& lamp : options.fill_lamps)
      fill_lamps_.push_back(to_eigen(lamp));
    // Points on a disc that faces the table's middle, evenly spread along a golden-angle spiral.
    const Vector3d towards_lamp = lamp_.normalized();
    const Vector3d aside = std::abs(towards_lamp.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
    lamp_u_ = towards_lamp.cross(aside).normalized();
    lamp_v_ = towards_lamp.cross(lamp_u_);
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < options.shadow_samples; ++i) {
      const double r = std::sqrt((i + 0.5) / options.shadow_samples) * options.lamp_radius;
      lamp_points_.push_back({r * std::cos(golden_angle * i), r * std::sin(golden_angle * i)});
    }
  }

  Sight look(const EigenRay& ray, const Point2& pixel) const {
    Sight sight;
    look_at_table(ray, sight);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (bodies_[i].window.holds(pixel))
        look_at_body(ray, i, sight);
    return sight;
  }

  /// The light that arrives at `pixel`; `random` turns the pattern of shadow rays.
  Sample sample(const Point2& pixel, std::uint64_t random) const {
    const auto seen = viewing_ray(camera_, pixel);
    if (!seen)
      return {};
    const EigenRay ray = to_eigen(*seen);
    const Sight sight = look(ray, pixel);
    return {vignette(pixel) * shade(ray, sight, random, true), sight.surface};
  }

private:
  void look_at_body(const EigenRay& ray, std::size_t index, Sight& sight) const {
    const auto hit = bodies_[index].body.hit(ray);
    if (!hit || hit->distance >= sight.distance)
      return;
    sight.object = static_cast<int>(index);
    sight.surface = surfaces_per_object * (sight.object + 1) + hit->face;
    sight.distance = hit->distance;
    sight.normal = hit->normal;
  }

  void look_at_table(const EigenRay& ray, Sight& sight) const {
    // Nearly all of the picture is the table's top, well within its edges.
    const double distance = -ray.origin().z() / ray.direction().z();
    const Vector3d point = ray.pointAt(distance);
    if (ray.direction().z() < 0 && distance > 0 && std::abs(point.x()) < inner_half_width_ &&
        std::abs(point.y()) < inner_half_depth_) {
      sight.surface = table_surface;
      sight.distance = distance;
      sight.normal = Vector3d::UnitZ();
    } else if (const auto hit = slab_.hit(ray)) {
      sight.surface = table_surface;
      sight.distance = hit->distance;
      sight.normal = hit->normal;
    }
  }

  double vignette(const Point2& pixel) const {
    const double x = (pixel.x - (camera_.width - 1) / 2.0) / camera_.width;
    const double y = (pixel.y - (camera_.height - 1) / 2.0) / camera_.height;
    return 1 - options_.vignetting * 2 * (x * x + y * y);
  }

  /// \param mirrors whether objects mirror what is around them.
  LinearColour shade(const EigenRay& ray, const Sight& sight, std::uint64_t random,
                     bool mirrors) const {
    if (sight.surface == room_surface)
      return shade_room(ray);
    const Vector3d point = ray.pointAt(sight.distance);
    const Vector3d to_lamp = lamp_ - point;
    const double distance = to_lamp.norm();
    const Vector3d lamp_direction = to_lamp / distance;
    const double facing = sight.normal.dot(lamp_direction);
    double lamp_light = 0;
    if (facing > 0)
      lamp_light =
        options_.lamp_intensity * lamp_distance_ / distance * lit_fraction(point, sight, random);
    if (sight.surface == table_surface)
      return shade_table(ray, sight, point, lamp_light * std::max(facing, 0.0));
    const LinearColour own = shade_object(ray, sight, lamp_direction, lamp_light, facing, point);
    const auto object = static_cast<std::size_t>(sight.object);
    const double share = object < options_.mirroring.size() ? options_.mirroring[object] : 0;
    if (!mirrors || !(share > 0))
      return own;
    return (1 - share) * own +
           share * (bodies_[object].reflectance * mirrored(ray, sight, point, random));
  }

  LinearColour shade_room(const EigenRay& ray) const {
    if (ray.direction().z() >= 0)
      return wall_light;
    const double distance = (floor_z - ray.origin().z()) / ray.direction().z();
    const Vector3d to_lamp = lamp_ - ray.pointAt(distance);
    const double facing = to_lamp.z() / to_lamp.norm();
    const LinearColour floor =
      (options_.ambient_intensity + 0.5 * options_.lamp_intensity * facing) * floor_reflectance;
    // It fades into the wall some metres away.
    const double nearness = std::exp(-std::max(0.0, distance - 1.5) / 2.5);
    return nearness * floor + (1 - nearness) * wall_light;
  }

  LinearColour shade_table(const EigenRay& ray, const Sight& sight, const Vector3d& point,
                           double lamp_light) const {
    const double slant = std::max(0.05, -ray.direction().dot(sight.normal));
    const double footprint = sight.distance * pixel_angle_ / std::sqrt(slant);
    double open = 1;
    for (const auto& object : bodies_)
      if (object.sky.holds(point))
        open -= covered_sky(point, object.body);
    double fill_light = 0;
    for (const auto& lamp : fill_lamps_)
      fill_light += options_.fill_intensity * std::max(0.0, (lamp - point).normalized().z());
    return (options_.ambient_intensity * std::max(open, 0.15) + lamp_light + fill_light) *
           texture_.at(point.x(), point.y(), footprint);
  }

  LinearColour shade_object(const EigenRay& ray, const Sight& sight, const Vector3d& lamp_direction,
                            double lamp_light, double facing, const Vector3d& point) const {
    const auto& object = bodies_[static_cast<std::size_t>(sight.object)];
    const double sky = 0.5 + 0.5 * sight.normal.z();
    // Light that the table throws back, the less the closer to the table, where the object itself
    // keeps the light off.
    const double height = std::clamp(point.z() / (2 * object.body.radius()), 0.0, 1.0);
    const double bounce = (1 - sky) * (0.35 + 0.65 * height) * 0.8;
    const LinearColour white{1, 1, 1};
    double diffuse = lamp_light * std::max(facing, 0.0);
    double highlight = highlight_of(ray, sight, lamp_direction, lamp_light);
    for (const auto& lamp : fill_lamps_) {
      const Vector3d direction = (lamp - point).normalized();
      diffuse += options_.fill_intensity * std::max(0.0, sight.normal.dot(direction));
      highlight += highlight_of(ray, sight, direction, options_.fill_intensity);
    }
    const LinearColour arriving =
      (options_.ambient_intensity * sky + diffuse) * white +
      (bounce * (options_.ambient_intensity + 0.5 * options_.lamp_intensity)) * texture_.average();
    return arriving * object.reflectance + highlight * white;
  }

  double highlight_of(const EigenRay& ray, const Sight& sight, const Vector3d& lamp_direction,
                      double lamp_light) const {
    if (!(sight.normal.dot(lamp_direction) > 0))
      return 0;
    const Vector3d halfway = (lamp_direction - ray.direction()).normalized();
    return options_.gloss * lamp_light *
           std::pow(std::max(0.0, sight.normal.dot(halfway)), shininess);
  }

  /// The light that comes to `point` from where a mirror there shows.
  LinearColour mirrored(const EigenRay& ray, const Sight& sight, const Vector3d& point,
                        std::uint64_t random) const {
    constexpr double off_the_surface = 1e-5;
    const Vector3d direction =
      ray.direction() - 2 * ray.direction().dot(sight.normal) * sight.normal;
    const EigenRay onwards(point + off_the_surface * sight.normal, direction.normalized());
    return shade(onwards, look_around(onwards, sight.object), random, false);
  }

  /// What the ray meets first, but for the object `self` that it comes from, which is convex.
  Sight look_around(const EigenRay& ray, int self) const {
    Sight sight;
    look_at_table(ray, sight);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (static_cast<int>(i) != self)
        look_at_body(ray, i, sight);
    return sight;
  }

  /// How much of the light from all around a body keeps off a point of the table: that of the
  /// sphere with the same middle and height, by its solid angle and direction.
  static double covered_sky(const Vector3d& point, const Body& body) {
    const Vector3d towards = body.centre() - point;
    const double squared = towards.squaredNorm();
    const double radius = sky_radius(body);
    if (squared > sky_reach * sky_reach * radius * radius || !(squared > 0))
      return 0;
    return 0.8 * towards.z() / std::sqrt(squared) * std::min(1.0, radius * radius / squared);
  }

  double lit_fraction(const Vector3d& point, const Sight& sight, std::uint64_t random) const {
    constexpr double off_the_surface = 1e-5;
    const Vector3d origin = point + off_the_surface * sight.normal;
    const Vector3d to_lamp = lamp_ - origin;
    const double distance = to_lamp.norm();
    const Vector3d direction = to_lamp / distance;
    // Only what comes near the straight line to the lamp can be in the way of any part of it.
    const SceneBody* near[64];
    std::size_t count = 0;
    for (std::size_t i = 0; i < bodies_.size() && count < std::size(near); ++i) {
      if (sight.surface == table_surface && !bodies_[i].shadow.holds(point))
        continue;
      const auto& body = bodies_[i].body;
      const Vector3d towards = body.centre() - origin;
      const double along = towards.dot(direction);
      const double reach =
        body.radius() + options_.lamp_radius * std::clamp(along / distance, 0.0, 1.0);
      if (along > -body.radius() && towards.squaredNorm() - along * along < reach * reach &&
          static_cast<int>(i) != sight.object)
        near[count++] = &bodies_[i];
    }
    if (count == 0)
      return 1;
    const double angle = static_cast<double>(random >> 11) * 0x1p-53 * 2 * std::numbers::pi;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    int lit = 0;
    for (const auto& [x, y] : lamp_points_) {
      const Vector3d aim =
        to_lamp + (cosine * x - sine * y) * lamp_u_ + (sine * x + cosine * y) * lamp_v_;
      const EigenRay ray(origin, aim.normalized());
      lit += std::none_of(near, near + count,
                          [&](const SceneBody* other) { return other->body.blocks(ray); });
    }
    return static_cast<double>(lit) / static_cast<double>(lamp_points_.size());
  }

  Camera camera_;
  RenderOptions options_;
  Body slab_;
  /// Within these the rounding of the slab's edges is out of reach.
  double inner_half_width_;
  double inner_half_depth_;
  TableTexture texture_;
  Vector3d lamp_;
  double lamp_distance_;
  std::vector<Vector3d> fill_lamps_;
  double pixel_angle_;
  Vector3d lamp_u_;
  Vector3d lamp_v_;
  std::vector<Point2> lamp_points_;
  std::vector<SceneBody> bodies_;
};

void expect_usable(const Camera& camera, const RenderOptions& options) {
  if (camera.width <= 0 || camera.height <= 0 || !(camera.fx > 0) || !(camera.fy > 0))
    throw std::invalid_argument("render: the camera needs a width, a height and focal lengths");
  if (options.shadow_samples < 1 || options.edge_samples < 1)
    throw std::invalid_argument("render: there must be at least one sample of each kind");
}

bool differ(const Sample& a, const Sample& b) {
  return a.surface != b.surface || std::abs(a.light.red - b.light.red) > edge_contrast ||
         std::abs(a.light.green - b.light.green) > edge_contrast ||
         std::abs(a.light.blue - b.light.blue) > edge_contrast;
}

/// Whether a pixel is unlike any of its neighbours.
bool is_edge(const std::vector<Sample>& samples, int width, int height, int x, int y) {
  const auto at = [&](int column, int row) -> const Sample& {
    return samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(column)];
  };
  const Sample& here = at(x, y);
  return (x > 0 && differ(here, at(x - 1, y))) || (x + 1 < width && differ(here, at(x + 1, y))) ||
         (y > 0 && differ(here, at(x, y - 1))) || (y + 1 < height && differ(here, at(x, y + 1)));
}

std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
}

Image empty_image(const Camera& camera, std::uint32_t channels) {
  Image image;
  image.width = static_cast<std::uint32_t>(camera.width);
  image.height = static_cast<std::uint32_t>(camera.height);
  image.channels = channels;
  image.bytes.resize(std::size_t{image.width} * image.height * channels);
  return image;
}

} // namespace

Image render_without_noise(const TabletopSnapshot& scene, const Camera& camera,
                           const RenderOptions& options) {
  expect_usable(camera, options);
  const Stage stage(scene, camera, options);
  Image image = empty_image(camera, 3);
  std::vector<Sample> samples;
  samples.reserve(image.bytes.size() / 3);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x)
      samples.push_back(
        stage.sample({static_cast<double>(x), static_cast<double>(y)}, mixed(samples.size())));
  std::size_t i = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x, ++i) {
      LinearColour light = samples[i].light;
      if (options.edge_samples > 1 && is_edge(samples, camera.width, camera.height, x, y)) {
        light = {};
        for (int s = 0; s < options.edge_samples; ++s) {
          // Spread over the pixel by the additive recurrence of M. Roberts' R2 sequence.
          const double dx = std::fmod(0.5 + 0.7548776662466927 * s, 1.0) - 0.5;
          const double dy = std::fmod(0.5 + 0.5698402909980532 * s, 1.0) - 0.5;
          const auto random = mixed(i * 64 + static_cast<std::size_t>(s));
          light = light + stage.sample({x + dx, y + dy}, random).light;
        }
        light = (1.0 / options.edge_samples) * light;
      }
      image.bytes[3 * i] = to_byte(to_display(light.blue));
      image.bytes[3 * i + 1] = to_byte(to_display(light.green));
      image.bytes[3 * i + 2] = to_byte(to_display(light.red));
    }
  }
  return image;
}

void add_sensor_noise(Image& image, double sigma, std::uint64_t seed, std::uint64_t frame) {
  if (!(sigma > 0))
    return;
  const std::uint64_t stream = mixed(mixed(seed) + frame);
  // The sum of four uniform 16-bit numbers is close enough to a normal distribution.
  const double mean = 2 * 65535.0;
  const double scale = sigma / (65536 * std::sqrt(4 / 12.0));
  for (std::size_t i = 0; i < image.bytes.size(); ++i) {
    const std::uint64_t random = mixed(stream + i);
    const auto sum = static_cast<double>((random & 0xFFFF) + (random >> 16 & 0xFFFF) +
                                         (random >> 32 & 0xFFFF) + (random >> 48));
    image.bytes[i] = to_byte(image.bytes[i] + scale * (sum - mean));
  }
}

Image render(const TabletopSnapshot& scene, const Camera& camera, const RenderOptions& options) {
  Image image = render_without_noise(scene, camera, options);
  add_sensor_noise(image, scene.noise, scene.seed, options.frame);
  return image;
}

Image render_labels(const TabletopSnapshot& scene, const Camera& camera) {
  const RenderOptions options;
  expect_usable(camera, options);
  const Stage stage(scene, camera, options);
  Image labels = empty_image(camera, 1);
  std::size_t i = 0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x, ++i) {
      const Point2 pixel{static_cast<double>(x), static_cast<double>(y)};
      if (const auto ray = viewing_ray(camera, pixel))
        labels.bytes[i] =
          static_cast<std::uint8_t>(std::min(stage.look(to_eigen(*ray), pixel).object + 1, 255));
    }
  return labels;
}

} // namespace castor::vision
