// The whole chain on CLEVR images, where there are any.

#include <algorithm>
#include <filesystem>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "castor/benchmarks/clevr/damage.hpp"
#include "castor/benchmarks/clevr/evaluation.hpp"
#include "castor/benchmarks/clevr/relations.hpp"
#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/camera/camera_model_file.hpp"

namespace castor::clevr {
namespace {

const std::filesystem::path data_folder = CASTOR_CLEVR;

double share(const Tally& tally) {
  return static_cast<double>(tally.hits) / static_cast<double>(tally.all);
}

TEST(RegionsOnClevr, are_found_named_and_related) {
  if (!std::filesystem::exists(data_folder))
    GTEST_SKIP() << "there are no CLEVR images at " << data_folder;
  const auto scenes = load_scenes(data_folder);
  ASSERT_FALSE(scenes.empty());
  vision::RegionOptions options;
  options.shape.candidates = {"cube", "cylinder", "sphere"};
  std::vector<Outcome> outcomes;
  for (const auto& scene : scenes)
    outcomes.push_back(evaluate(scene, CameraGuess{}, options, vision::trained_shape_network()));
  const Summary summary = summarize(outcomes);
  EXPECT_GE(share(summary.recall), 0.95);
  EXPECT_GE(share(summary.precision), 0.95);
  EXPECT_GE(share(summary.colour), 0.98);
  // The shapes were trained on these very images; the benchmark leaves each out in turn.
  EXPECT_GE(share(summary.shape), 0.95);
  EXPECT_GE(share(summary.size), 0.95);
  const auto relations = judge_relations(outcomes, make_camera(CameraGuess{}, 320, 240, 1));
  ASSERT_GT(relations.all.all, 0u);
  EXPECT_GE(share(relations.all), 0.98);
}

TEST(DamagedRegions, are_much_of_the_region_and_look_like_one) {
  constexpr int side = 80;
  vision::Image image{side, side, 3, std::vector<std::uint8_t>(3 * side * side, 90)};
  vision::Segment segment;
  segment.box = {{40, 40}, 31, 31};
  segment.mask = {31, 31, 1, std::vector<std::uint8_t>(31 * 31, 255)};
  const auto region = make_roi(image, segment);
  std::mt19937 random(5);
  std::size_t changed = 0;
  for (int i = 0; i < 50; ++i) {
    const auto other = damaged(region, image, random);
    if (other.region.bytes.empty())
      continue;
    EXPECT_EQ(other.mask.width, other.region.width);
    EXPECT_EQ(other.mask.height, other.region.height);
    EXPECT_FALSE(other.contour.empty());
    const auto pixels = std::count_if(other.mask.bytes.begin(), other.mask.bytes.end(),
                                      [](auto x) { return x != 0; });
    EXPECT_GT(pixels, 31 * 31 / 20);
    EXPECT_LT(pixels, 31 * 31 * 2);
    changed += pixels != 31 * 31 ? 1 : 0;
  }
  EXPECT_GT(changed, 40U);
}

TEST(CameraOfClevr, is_the_same_in_its_file) {
  const CameraGuess guess{{7.25, -6.5, 5.0 / 3}, {0.125, -0.25}};
  const auto read = vision::parse_camera(camera_file(guess, 320, 240, 0.088), "clevr.camera");
  ASSERT_TRUE(read.camera);
  const geometry::Camera camera = make_camera(guess, 320, 240, 0.088);
  EXPECT_EQ(read.camera->width, 320);
  EXPECT_EQ(read.camera->height, 240);
  for (const geometry::Point3& point :
       {geometry::Point3{0, 0, 0}, {0.2, 0.1, 0.05}, {-0.2, 0.15, 0}}) {
    const auto expected = project(camera, point);
    const auto is = project(*read.camera, point);
    ASSERT_TRUE(expected && is);
    EXPECT_NEAR(is->x, expected->x, 1e-9);
    EXPECT_NEAR(is->y, expected->y, 1e-9);
  }
}

} // namespace
} // namespace castor::clevr
