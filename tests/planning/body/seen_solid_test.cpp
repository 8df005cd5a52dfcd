// Solids by the outlines that vision finds in rendered pictures.

#include "castor/mapping/geometry/seen_solid.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/perception/vision/segmentation/segmentation.hpp"
#include "castor/perception/vision/segmentation/size_limits.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"
#include "castor/planning/manipulation/seen_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace castor::manipulation {

namespace {

using geometry::seen_solid;
using geometry::SeenSolid;

struct Seen {
  vision::TabletopObject truth;
  SeenSolid solid;
};

/// The solid of the only region in the picture of this thing.
std::optional<Seen> look_at(const std::string& thing, const std::string& shape) {
  const auto scene = vision::parse_tabletop_scene(
                       "camera 0 -0.34 0.92 looking-at 0 0.02 0 fov 38\n" + thing + '\n', "test")
                       .scene;
  const auto picture = vision::render(scene.at(vision::SceneTime{0}), scene.camera);
  const auto segments = vision::segment_table(picture, &scene.camera, {}, {});
  if (segments.size() != 1)
    return {};
  const auto solid = seen_solid(shape, segments.front().contour, scene.camera);
  if (!solid)
    return {};
  return Seen{scene.at(vision::SceneTime{0}).objects.front(), *solid};
}

double off(const Seen& x) {
  return std::hypot(x.solid.pose.position.x - x.truth.x, x.solid.pose.position.y - x.truth.y);
}

TEST(SeenSolid, ABallIsWhereItIs) {
  for (const auto* place : {"0 0", "0.2 0.1", "-0.2 -0.15", "0.1 -0.2"}) {
    const auto x = look_at(std::string("blue sphere at ") + place + " size 0.055", "sphere");
    ASSERT_TRUE(x) << place;
    EXPECT_LT(off(*x), 0.004) << place;
    EXPECT_NEAR(x->solid.solid.size.x, 0.055, 0.004) << place;
    EXPECT_NEAR(x->solid.pose.position.z, 0.0275, 0.002);
    EXPECT_EQ(x->solid.pose.frame, "table");
  }
}

TEST(SeenSolid, ACubeIsTurnedAsItIs) {
  for (const auto* place : {"0 0 size 0.05 turned 10", "0.2 0.05 size 0.05 turned 40",
                            "-0.2 -0.15 size 0.05 turned 65", "0.1 -0.2 size 0.05 turned 85"}) {
    const auto x = look_at(std::string("red cube at ") + place, "cube");
    ASSERT_TRUE(x) << place;
    EXPECT_LT(off(*x), 0.004) << place;
    EXPECT_NEAR(x->solid.solid.size.x, 0.05, 0.004) << place;
    const auto wanted =
      geometry::rotation_about_z(x->truth.turned_degrees * std::numbers::pi / 180);
    const double turn =
      std::fmod(geometry::angle_between(x->solid.pose.rotation, wanted), std::numbers::pi / 2);
    EXPECT_LT(std::min(turn, std::numbers::pi / 2 - turn), 0.12) << place;
  }
}

TEST(SeenSolid, ACylinderIsAsHighAsItIs) {
  for (const auto* place : {"0 0", "0.2 0.1", "-0.2 -0.1"}) {
    const auto x =
      look_at(std::string("green cylinder at ") + place + " size 0.05 0.08", "cylinder");
    ASSERT_TRUE(x) << place;
    EXPECT_LT(off(*x), 0.005) << place;
    EXPECT_NEAR(x->solid.solid.size.x, 0.05, 0.005) << place;
    EXPECT_NEAR(x->solid.solid.size.z, 0.08, 0.012) << place;
  }
}

/// From above, a higher cylinder looks like a wider one.
TEST(SeenSolid, TheHeightBelowTheCameraIsKnownLessWell) {
  double aside = 0;
  for (const auto* place : {"0.25 0.1", "0 -0.15", "-0.02 -0.18", "0.04 -0.2"}) {
    const auto x =
      look_at(std::string("red cylinder at ") + place + " size 0.05 0.088", "cylinder");
    ASSERT_TRUE(x) << place;
    const double too_low = 0.088 - x->solid.solid.size.z;
    EXPECT_LT(too_low, 2 * x->solid.height_deviation) << place;
    if (aside == 0)
      aside = x->solid.height_deviation;
    else
      EXPECT_GT(x->solid.height_deviation, 1.5 * aside) << place;
  }
  const auto ball = look_at("red sphere at 0 -0.15 size 0.05", "sphere");
  ASSERT_TRUE(ball);
  EXPECT_EQ(ball->solid.height_deviation, 0);
}

TEST(SeenSolid, AFlatPieceIsFlat) {
  const auto x = look_at("yellow disc at 0.1 0 size 0.09", "circle");
  ASSERT_TRUE(x);
  EXPECT_LT(off(*x), 0.004);
  EXPECT_NEAR(x->solid.solid.size.x, 0.09, 0.004);
  EXPECT_NEAR(x->solid.solid.size.z, 0.005, 1e-9);
}

/// As what is nearly hidden may look, or be taken for.
TEST(SeenSolid, WhatIsNoFlatPieceIsNotSeenAsASlice) {
  const auto scene =
    vision::parse_tabletop_scene("camera 0 -0.34 0.92 looking-at 0 0.02 0 fov 38\n"
                                 "red rectangle at 0.1 0 size 0.05 0.09 turned 20\n",
                                 "test")
      .scene;
  const auto picture = vision::render(scene.at(vision::SceneTime{0}), scene.camera);
  const auto segments = vision::segment_table(picture, &scene.camera, {}, {});
  ASSERT_EQ(segments.size(), 1U);
  for (const auto* shape : {"cube", "rectangle"}) {
    SeenEntries entries;
    entries.camera = scene.camera;
    entries.regions["r"].contour = segments.front().contour;
    vision::SceneObject object;
    object.shape = {shape, 0.9};
    object.roi_ids = {"r"};
    object.box = {{0.1, 0, 0.025}, {0.05, 0.05, 0.05}, "table"};
    entries.objects["1"] = object;
    const auto things = seen_things(entries, {{0, -0.37, 0}, {}, "table"});
    ASSERT_EQ(things.size(), 1U) << shape;
    const bool is_flat = things.front().thing.solid.size.z < 0.01;
    EXPECT_EQ(is_flat, shape == std::string("rectangle")) << shape;
  }
}

/// What lies behind another thing, seen from the camera, goes on behind it.
TEST(SeenSolid, WhatIsPartlyHiddenIsWhereItIs) {
  const auto scene = vision::parse_tabletop_scene("camera 0 -0.34 0.92 looking-at 0 0.02 0 fov 38\n"
                                                  "green cylinder at 0.1 0.04 size 0.05 0.09\n"
                                                  "red cube at 0.11 0.093 size 0.045 turned 20\n",
                                                  "test")
                       .scene;
  const auto picture = vision::render(scene.at(vision::SceneTime{0}), scene.camera);
  const auto segments = vision::segment_table(picture, &scene.camera, {}, {});
  ASSERT_EQ(segments.size(), 2U);
  const auto height = [](const auto& x) {
    return std::ranges::min(x.contour, {}, &geometry::Point2::y).y;
  };
  const std::size_t further = height(segments[0]) < height(segments[1]) ? 0 : 1;
  const auto& cube = segments[further];
  const auto& cylinder = segments[1 - further];
  const auto off = [&](const std::vector<std::vector<geometry::Point2>>& others) {
    const auto x = seen_solid("cube", cube.contour, scene.camera, others);
    return x ? std::hypot(x->pose.position.x - 0.11, x->pose.position.y - 0.093) : 1;
  };
  EXPECT_LT(off({cylinder.contour}), 0.004);
  EXPECT_LT(off({cylinder.contour}), off({}) / 2);
}

TEST(SeenSolid, WhatDoesNotFitHasALargeError) {
  const auto ball = look_at("blue sphere at 0 0 size 0.06", "sphere");
  const auto cube = look_at("blue sphere at 0 0 size 0.06", "cube");
  ASSERT_TRUE(ball && cube);
  EXPECT_LT(ball->solid.error, 1.5);
  EXPECT_GT(cube->solid.error, 2 * ball->solid.error);
}

TEST(SeenSolid, NothingIsSeenAboveTheHorizonOrInNoOutline) {
  const auto camera =
    vision::parse_tabletop_scene("camera 0 -1 0.1 looking-at 0 0 0.1 fov 50\n", "test")
      .scene.camera;
  EXPECT_FALSE(seen_solid("cube", {{10, 10}, {20, 10}, {20, 20}}, camera));
  EXPECT_FALSE(seen_solid("cube", {{10, 10}, {20, 10}}, camera));
}

} // namespace

} // namespace castor::manipulation
