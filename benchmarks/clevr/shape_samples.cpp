#include "castor/benchmarks/clevr/shape_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include <opencv2/imgcodecs.hpp>

#include "castor/benchmarks/clevr/clevr_camera.hpp"
#include "castor/benchmarks/clevr/clevr_truth.hpp"
#include "castor/benchmarks/clevr/damage.hpp"
#include "castor/benchmarks/clevr/matching.hpp"
#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/recognition/outline_fit.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/recognition/shape_evidence.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

namespace castor::clevr {

namespace {

using vision::Image;
using vision::TabletopShape;

std::size_t shape_index(const std::string& name) {
  const auto& names = vision::shape_vocabulary();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::runtime_error("there is no shape \"" + name + "\" to train for");
  return static_cast<std::size_t>(found - names.begin());
}

Image mirrored(const Image& image) {
  cv::Mat result;
  cv::flip(vision::as_mat(image), result, 1);
  return vision::to_image(result);
}

/// Measures regions whose shape is known.
class Measurer {
public:
  /// \param damages number of damaged variants of each region; together they weigh as much as the
  ///        region itself.
  Measurer(int damages, double weight) : damages_(damages), weight_(weight) {
    // nop
  }

  /// \param camera the region is compared with what this one would see.
  /// \param shapes of the objects that `labels` count from 0.
  void add(const Image& image, const geometry::Camera& camera, const cv::Mat_<int>& labels,
           const std::vector<std::size_t>& shapes, std::size_t scene) {
    std::mt19937 random(static_cast<std::uint32_t>(scene));
    std::vector<vision::ROI> regions;
    for (const auto& segment : vision::segment(image))
      regions.push_back(make_roi(image, segment));
    std::vector<const vision::ROI*> pointers;
    for (const auto& region : regions)
      pointers.push_back(&region);
    for (const auto& match : match_regions(pointers, labels, shapes.size(), sample_overlap)) {
      const vision::ROI& region = regions[match.region];
      const std::size_t shape = shapes[match.object];
      add_views(region, camera, shape, weight_, scene);
      for (int i = 0; i < damages_; ++i)
        add_views(damaged(region, image, random), camera, shape, weight_ / damages_, scene);
    }
  }

  std::vector<Sample> take() { return std::move(samples_); }

private:
  /// With and without the camera, and mirrored, which changes nothing in how well shapes fit.
  void add_views(const vision::ROI& region, const geometry::Camera& camera, std::size_t shape,
                 double weight, std::size_t scene) {
    if (region.region.bytes.empty())
      return;
    const Image mirrored_region = mirrored(region.region);
    const Image mirrored_mask = mirrored(region.mask);
    const auto fit = measure_fit(region, camera);
    for (auto& evidence :
         {measure_shape(region.region, region.mask, fit),
          measure_shape(mirrored_region, mirrored_mask, fit),
          samples_.size() % 2 == 0 ? measure_shape(region.region, region.mask)
                                   : measure_shape(mirrored_region, mirrored_mask)}) {
      if (!evidence.empty())
        samples_.push_back({evidence, shape, weight, scene});
    }
  }

  int damages_;
  double weight_;
  std::vector<Sample> samples_;
};

/// Makes up tables.
class TableMaker {
public:
  explicit TableMaker(std::uint32_t seed) : random_(seed) {
    // nop
  }

  /// Chooses anew what kind of scene the next calls make: every other one is of solids on an even
  /// grey ground in the light of several lamps, as a studio has them.
  void begin_scene() { studio_ = !studio_; }

  vision::TabletopSnapshot scene() {
    vision::TabletopSnapshot scene;
    using Material = vision::TableLook::Material;
    scene.table.material =
      studio_ ? Material::plain
              : std::array{Material::wood, Material::cloth, Material::plain}[index(3)];
    const auto grey = static_cast<std::uint8_t>(between(studio_ ? 110 : 70, studio_ ? 190 : 240));
    scene.table.colour =
      studio_ || index(2) == 0 ? vision::SceneColour{grey, grey, grey} : colour();
    scene.light = {between(-1.5, 1.5), between(-1.5, 1.5), between(1.2, 2.5)};
    scene.noise = between(0.5, 3);
    scene.seed = random_();
    const auto count = 3 + index(studio_ ? 7 : 5);
    for (int attempt = 0; attempt < 60 && scene.objects.size() < count; ++attempt) {
      const auto candidate = studio_ ? solid() : object();
      const bool free =
        std::none_of(scene.objects.begin(), scene.objects.end(),
                     [&](const auto& other) { return vision::overlap(candidate, other); });
      if (free)
        scene.objects.push_back(candidate);
    }
    return scene;
  }

  geometry::Camera camera() {
    const double elevation = between(studio_ ? 20 : 18, studio_ ? 42 : 70) * std::numbers::pi / 180;
    const double azimuth = between(0, 2 * std::numbers::pi);
    const double distance = studio_ ? between(0.85, 1.15) : between(0.55, 1.2);
    const double level = distance * std::cos(elevation);
    return geometry::look_at(
      {level * std::cos(azimuth), level * std::sin(azimuth), distance * std::sin(elevation)},
      {between(-0.05, 0.05), between(-0.05, 0.05), 0},
      between(studio_ ? 34 : 28, studio_ ? 42 : 45), 320, 240);
  }

  /// A calibration of that camera that is a little off.
  geometry::Camera misjudged(geometry::Camera camera) {
    camera.pose.position.x += between(-0.02, 0.02);
    camera.pose.position.y += between(-0.02, 0.02);
    camera.pose.position.z += between(-0.02, 0.02);
    return camera;
  }

  /// Light for a scene of so many objects.
  vision::RenderOptions options(std::size_t objects) {
    vision::RenderOptions options;
    options.lamp_intensity = between(0.4, 0.9);
    options.ambient_intensity = between(0.15, 0.5);
    options.lamp_radius = between(0.02, 0.3);
    options.gloss = between(0, 0.6);
    options.shadow_samples = 8;
    options.edge_samples = 4;
    for (std::size_t i = index(4); i > 0; --i)
      options.fill_lamps.push_back({between(-2, 2), between(-2, 2), between(0.8, 2.5)});
    options.fill_intensity = between(0.05, 0.3);
    for (std::size_t i = 0; i < objects; ++i)
      options.mirroring.push_back(index(studio_ ? 2 : 4) == 0 ? between(0.2, 0.8) : 0);
    return options;
  }

private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::size_t index(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }

  vision::SceneColour colour() {
    const auto channel = [this] { return static_cast<std::uint8_t>(between(20, 245)); };
    return {channel(), channel(), channel()};
  }

  /// A cube, a sphere or a cylinder as high as it is wide.
  vision::TabletopObject solid() {
    constexpr std::array shapes{TabletopShape::cube, TabletopShape::cylinder,
                                TabletopShape::sphere};
    vision::TabletopObject object;
    object.shape = shapes[index(shapes.size())];
    object.colour = colour();
    object.x = between(-0.26, 0.26);
    object.y = between(-0.26, 0.26);
    object.turned_degrees = between(0, 360);
    const double side = index(2) == 0 ? between(0.055, 0.07) : between(0.1, 0.13);
    object.size = {side, side, side};
    return object;
  }

  vision::TabletopObject object() {
    constexpr std::array shapes{TabletopShape::cube,     TabletopShape::cylinder,
                                TabletopShape::sphere,   TabletopShape::square,
                                TabletopShape::triangle, TabletopShape::rectangle,
                                TabletopShape::disc};
    vision::TabletopObject object;
    object.shape = shapes[index(shapes.size())];
    object.colour = colour();
    object.x = between(-0.3, 0.3);
    object.y = between(-0.3, 0.3);
    object.turned_degrees = between(0, 360);
    const bool flat = vision::is_flat(object.shape);
    const double side = between(0.04, flat ? 0.14 : 0.11);
    object.size = {side, side, flat ? 0.005 : side};
    if (object.shape == TabletopShape::rectangle)
      object.size.y = side / between(1.5, 3);
    if (object.shape == TabletopShape::cylinder)
      object.size.z = side * between(0.8, 1.8);
    return object;
  }

  std::mt19937 random_;
  bool studio_ = false;
};

std::size_t shape_index(TabletopShape shape) {
  return shape_index(shape == TabletopShape::disc ? std::string("circle")
                                                  : std::string(to_string(shape)));
}

} // namespace

std::vector<Sample> clevr_samples(std::span<const Scene> scenes, double weight) {
  Measurer measurer(clevr_damages, weight);
  for (std::size_t index = 0; index < scenes.size(); ++index) {
    const Scene& scene = scenes[index];
    const cv::Mat pixels = cv::imread(scene.image.string());
    if (pixels.empty())
      throw std::runtime_error("cannot read " + scene.image.string());
    const Scene* only = &scene;
    // One object alone leaves room for many cameras; those near the usual one are likelier.
    const CameraGuess guess = fit_camera({&only, 1}, {}, 0.3, pixels.cols, pixels.rows);
    const auto camera = make_camera(guess, pixels.cols, pixels.rows, 1);
    std::vector<std::size_t> shapes;
    for (const auto& object : scene.objects)
      shapes.push_back(shape_index(object.shape));
    // Whoever is to recognise things does not know how CLEVR has moved its camera.
    measurer.add(vision::to_image(pixels), make_camera({}, pixels.cols, pixels.rows, 1),
                 visible_objects(scene, camera, pixels.size()), shapes, index);
  }
  return measurer.take();
}

std::vector<Sample> rendered_samples(int count, std::uint32_t seed, std::size_t first_scene) {
  Measurer measurer(rendered_damages, 1);
  TableMaker maker(seed);
  for (int i = 0; i < count; ++i) {
    maker.begin_scene();
    const auto scene = maker.scene();
    const auto camera = maker.camera();
    const Image image = render(scene, camera, maker.options(scene.objects.size()));
    const Image truth = render_labels(scene, camera);
    cv::Mat_<int> labels;
    vision::as_mat(truth).convertTo(labels, CV_32S);
    labels -= 1;
    std::vector<std::size_t> shapes;
    for (const auto& object : scene.objects)
      shapes.push_back(shape_index(object.shape));
    measurer.add(image, maker.misjudged(camera), labels, shapes,
                 first_scene + static_cast<std::size_t>(i));
  }
  return measurer.take();
}

} // namespace castor::clevr
