#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer_body.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer_light.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"

namespace castor::vision {

using namespace geometry;

namespace {

using namespace std::chrono_literals;

constexpr auto six_objects = "camera 0 -0.62 0.55 looking-at 0 0.03 0 fov 42\n"
                             "image 320 240\n"
                             "blue square at -0.2 -0.08 size 0.09\n"
                             "red triangle at 0 -0.13 size 0.1\n"
                             "yellow disc at 0.2 -0.1\n"
                             "green cube at -0.16 0.14 size 0.07 turned 30\n"
                             "red sphere at 0.05 0.07 size 0.07\n"
                             "purple cylinder at 0.23 0.15\n";

struct Setup {
  TabletopSnapshot snapshot;
  Camera camera;
};

Setup setup_of(const std::string& text) {
  const auto result = parse_tabletop_scene(text, "test.scene");
  EXPECT_EQ(render(result.problems), "");
  return {result.scene.at(0s), result.scene.camera};
}

/// B, G, R at a point of the table.
std::array<int, 3> colour_at(const Image& image, const Camera& camera, const Point3& point) {
  const auto pixel = project(camera, point);
  EXPECT_TRUE(pixel);
  const auto x = static_cast<std::size_t>(std::lround(pixel->x));
  const auto y = static_cast<std::size_t>(std::lround(pixel->y));
  const std::size_t i = (y * image.width + x) * image.channels;
  return {image.bytes[i], image.bytes[i + 1], image.bytes[i + 2]};
}

int brightness(const std::array<int, 3>& colour) {
  return colour[0] + colour[1] + colour[2];
}

TEST(Renderer, ShowsObjectsInTheirColours) {
  const auto [snapshot, camera] = setup_of(six_objects);
  const auto image = render(snapshot, camera);
  ASSERT_EQ(image.width, 320U);
  ASSERT_EQ(image.height, 240U);
  ASSERT_EQ(image.bytes.size(), 320U * 240 * 3);
  const auto blue = colour_at(image, camera, {-0.2, -0.08, 0.005});
  EXPECT_GT(blue[0], 2 * blue[2]);
  const auto red = colour_at(image, camera, {0, -0.13, 0.005});
  EXPECT_GT(red[2], 2 * red[0]);
  const auto yellow = colour_at(image, camera, {0.2, -0.1, 0.005});
  EXPECT_GT(yellow[2], 150);
  EXPECT_GT(yellow[1], 2 * yellow[0]);
  const auto green = colour_at(image, camera, {-0.16, 0.14, 0.07});
  EXPECT_GT(green[1], green[2] * 3 / 2);
}

TEST(Renderer, CastsShadowsAwayFromTheLamp) {
  const auto [snapshot, camera] = setup_of("camera 0 -0.62 0.55\ntable grey\nlight -1 0 1.5\n"
                                           "white cylinder at 0 0 size 0.06 0.12\n");
  const auto image = render_without_noise(snapshot, camera);
  const int shadow = brightness(colour_at(image, camera, {0.06, 0, 0}));
  const int lit = brightness(colour_at(image, camera, {-0.12, 0, 0}));
  EXPECT_LT(shadow, lit * 6 / 10);
  EXPECT_GT(shadow, 30);
}

TEST(Renderer, IsDeterministicAndNoisyByFrame) {
  const auto [snapshot, camera] = setup_of(six_objects);
  RenderOptions first;
  RenderOptions second;
  second.frame = 1;
  EXPECT_EQ(render(snapshot, camera, first), render(snapshot, camera, first));
  EXPECT_NE(render(snapshot, camera, first), render(snapshot, camera, second));
  TabletopSnapshot other_seed = snapshot;
  other_seed.seed = 99;
  EXPECT_NE(render(snapshot, camera), render(other_seed, camera));
  TabletopSnapshot quiet = snapshot;
  quiet.noise = 0;
  EXPECT_EQ(render(quiet, camera, first), render(quiet, camera, second));
  EXPECT_EQ(render(quiet, camera), render_without_noise(snapshot, camera));
}

TEST(Renderer, HasNoiseOfTheGivenStrength) {
  Image image{200, 200, 3, std::vector<std::uint8_t>(200 * 200 * 3, 128)};
  add_sensor_noise(image, 4, 1, 0);
  double sum = 0;
  double squares = 0;
  for (const int value : image.bytes) {
    sum += value - 128;
    squares += (value - 128) * (value - 128);
  }
  const auto count = static_cast<double>(image.bytes.size());
  EXPECT_NEAR(sum / count, 0, 0.1);
  EXPECT_NEAR(std::sqrt(squares / count), 4, 0.1);
}

TEST(Renderer, TellsWhichObjectIsSeenWhere) {
  const auto [snapshot, camera] = setup_of(six_objects);
  const auto labels = render_labels(snapshot, camera);
  ASSERT_EQ(labels.channels, 1U);
  for (std::size_t i = 0; i < snapshot.objects.size(); ++i) {
    const auto pixel = project(camera, pose_of(snapshot.objects[i]).position);
    const auto index = static_cast<std::size_t>(std::lround(pixel->y)) * labels.width +
                       static_cast<std::size_t>(std::lround(pixel->x));
    EXPECT_EQ(labels.bytes[index], i + 1);
  }
  EXPECT_EQ(labels.bytes[0], 0);
}

TEST(Renderer, ShowsNearThingsBeforeFarOnes) {
  const auto [snapshot, camera] = setup_of("camera 0 -0.8 0.2\n"
                                           "blue cube at 0 0.1 size 0.06\n"
                                           "red box at 0 -0.1 size 0.2 0.05 0.2\n");
  const auto labels = render_labels(snapshot, camera);
  const auto pixel = project(camera, {0, 0.1, 0.03});
  EXPECT_EQ(labels.bytes[static_cast<std::size_t>(std::lround(pixel->y)) * labels.width +
                         static_cast<std::size_t>(std::lround(pixel->x))],
            2);
}

TEST(Renderer, SmoothsEdges) {
  const auto [snapshot, camera] =
    setup_of("camera 0 -0.1 0.8\ntable black\nwhite square at 0 0 size 0.2 turned 20\n");
  RenderOptions jagged;
  jagged.edge_samples = 1;
  const auto count_between = [](const Image& image) {
    int count = 0;
    for (std::size_t i = 0; i < image.bytes.size(); i += 3)
      count += image.bytes[i] > 110 && image.bytes[i] < 170;
    return count;
  };
  EXPECT_GT(count_between(render_without_noise(snapshot, camera)),
            2 * count_between(render_without_noise(snapshot, camera, jagged)));
}

TEST(Renderer, FollowsTheLensOfTheCamera) {
  auto [snapshot, camera] = setup_of(six_objects);
  camera.k1 = -0.3;
  camera.k2 = 0.1;
  const auto labels = render_labels(snapshot, camera);
  const auto pixel = project(camera, pose_of(snapshot.objects[3]).position);
  EXPECT_EQ(labels.bytes[static_cast<std::size_t>(std::lround(pixel->y)) * labels.width +
                         static_cast<std::size_t>(std::lround(pixel->x))],
            4);
}

TEST(Renderer, MirrorsWhatIsAround) {
  const auto [snapshot, camera] = setup_of("camera 0 -0.62 0.55 looking-at 0 0.03 0 fov 42\n"
                                           "image 320 240\n"
                                           "white cube at 0 0.05 size 0.1\n"
                                           "red sphere at 0 -0.07 size 0.06\n");
  const Point3 on_the_front{0, 0, 0.05};
  const auto matt = colour_at(render_without_noise(snapshot, camera), camera, on_the_front);
  RenderOptions options;
  options.mirroring = {0.8};
  const auto shiny =
    colour_at(render_without_noise(snapshot, camera, options), camera, on_the_front);
  EXPECT_LT(matt[2], 1.2 * matt[0]);
  EXPECT_GT(shiny[2], 1.3 * shiny[0]);
}

TEST(Renderer, HasLampsWithoutShadows) {
  const auto [snapshot, camera] = setup_of(six_objects);
  RenderOptions options;
  const Point3 bare{-0.05, 0.2, 0};
  const auto before = colour_at(render_without_noise(snapshot, camera, options), camera, bare);
  options.lamp_intensity = 0.4;
  const auto dim = colour_at(render_without_noise(snapshot, camera, options), camera, bare);
  options.fill_lamps = {{0.5, -0.5, 1}, {-0.5, -0.5, 1}};
  options.fill_intensity = 0.2;
  const auto filled = colour_at(render_without_noise(snapshot, camera, options), camera, bare);
  EXPECT_LT(brightness(dim), brightness(before) - 60);
  EXPECT_GT(brightness(filled), brightness(dim) + 60);
}

TEST(Renderer, ShowsPlacedObjectsAsThoseOnTheTable) {
  const auto scene = parse_tabletop_scene("red cylinder at 0.1 0.05 size 0.06 0.1 name=can\n"
                                          "green triangle at -0.1 0 size 0.1 turned 20\n",
                                          "test")
                       .scene;
  const auto standing = scene.at(0s);
  auto placed = standing;
  placed.objects.clear();
  for (const auto& x : standing.objects)
    placed.placed.push_back({x, pose_of(x)});
  EXPECT_EQ(render_labels(placed, scene.camera), render_labels(standing, scene.camera));
}

TEST(Renderer, ShowsObjectsThatLieOrHover) {
  const auto camera = look_at({0, 0, 2}, {0, 0, 0}, 40, 200, 200, table_frame);
  TabletopObject can;
  can.shape = TabletopShape::cylinder;
  can.size = {0.04, 0.04, 0.2};
  TabletopSnapshot scene;
  scene.placed.push_back({can, {{0, 0, 0.3}, {}, table_frame}});
  const auto pixels = [&] {
    int count = 0;
    for (const auto x : render_labels(scene, camera).bytes)
      count += x == 1;
    return count;
  };
  const int from_above = pixels();
  // On its side: a quarter turn about x.
  scene.placed[0].pose.rotation = {std::sqrt(0.5), std::sqrt(0.5), 0, 0};
  EXPECT_GT(pixels(), 4 * from_above);
  // Its shadow is on the table.
  const auto with = render_without_noise(scene, camera);
  scene.placed.clear();
  const auto without = render_without_noise(scene, camera);
  int darker = 0;
  for (std::size_t i = 0; i < with.bytes.size(); i += 3)
    darker += with.bytes[i] + 20 < without.bytes[i];
  EXPECT_GT(darker, 100);
}

TEST(Renderer, RefusesCamerasWithoutImage) {
  EXPECT_THROW(render({}, Camera{}), std::invalid_argument);
  RenderOptions options;
  options.shadow_samples = 0;
  EXPECT_THROW(render({}, nominal_camera(32, 24), options), std::invalid_argument);
}

TEST(Body, IsHitWhereItIs) {
  TabletopObject object;
  for (const auto shape : {TabletopShape::cube, TabletopShape::cylinder, TabletopShape::sphere}) {
    object.shape = shape;
    object.size = {0.1, 0.1, 0.1};
    const Body body(object);
    const auto hit = body.hit({{0, 0, 1}, {0, 0, -1}});
    ASSERT_TRUE(hit) << to_string(shape);
    EXPECT_NEAR(hit->distance, 0.9, 1e-12);
    EXPECT_NEAR(hit->normal.z(), 1, 1e-12);
    const auto side = body.hit({{-1, 0, 0.05}, {1, 0, 0}});
    ASSERT_TRUE(side) << to_string(shape);
    EXPECT_NEAR(side->distance, 0.95, 1e-12);
    EXPECT_NEAR(side->normal.x(), -1, 1e-12);
    EXPECT_FALSE(body.hit({{0, 0, 1}, {0, 0, 1}})) << "the body is behind";
    EXPECT_FALSE(body.hit({{0.06, 0, 1}, {0, 0, -1}})) << "the ray passes by";
    EXPECT_TRUE(body.blocks({{0, 0, 1}, {0, 0, -1}}, 0.95));
    EXPECT_FALSE(body.blocks({{0, 0, 1}, {0, 0, -1}}, 0.85));
  }
}

TEST(Light, IsShownAsTheColourThatItCameFrom) {
  for (int value = 0; value <= 220; value += 10) {
    const auto byte = static_cast<std::uint8_t>(value);
    const auto light = to_linear({byte, byte, byte});
    if (light.red <= 0.8) {
      EXPECT_NEAR(to_display(light.red), value, 0.7);
    }
  }
  EXPECT_EQ(to_display(-1), 0);
  EXPECT_LE(to_display(1e9), 255);
}

} // namespace

} // namespace castor::vision
