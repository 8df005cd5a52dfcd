#include "castor/perception/spatial/scene_relations.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace castor::spatial {

namespace {

using enum SpatialRelation;

TEST(SceneRelations, HoldAboveTheirThreshold) {
  const std::vector<ScenePlace> places{{"square", {0.15, 0}}, {"triangle", {-0.15, 0}}};
  EXPECT_TRUE(relationships(right, places, {0, -1}).empty());
  RelationThresholds playmate;
  playmate.projective = 0.7;
  const auto found = relationships(right, places, {0, -1}, {}, playmate);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].relation, right);
  EXPECT_EQ(found[0].target, "square");
  EXPECT_EQ(found[0].landmark, "triangle");
  EXPECT_NEAR(found[0].value, .7261, 0.5e-4);
  EXPECT_TRUE(relationships(near, places, {0, -1}, {}, playmate).empty());
  playmate.proximity = 0.64;
  EXPECT_EQ(relationships(near, places, {0, -1}, {}, playmate).size(), 2u);
}

TEST(SceneRelations, HaveAListEach) {
  SpatialScene scene;
  for (auto relation : all_spatial_relations)
    list_of(scene, relation).push_back({relation, "a", "b", 1});
  EXPECT_EQ(scene.near.at(0).relation, near);
  EXPECT_EQ(scene.front.at(0).relation, front);
  EXPECT_EQ(scene.back.at(0).relation, back);
  EXPECT_EQ(scene.left.at(0).relation, left);
  EXPECT_EQ(scene.right.at(0).relation, right);
}

TEST(SceneRelations, LeaveOutStaticPointsWhereAnObjectIs) {
  const std::vector<GroundPoint> objects{{0, 0}, {0.5, 0}};
  EXPECT_FALSE(is_free({0.02, 0.02}, objects));
  EXPECT_TRUE(is_free({0.03, 0.02}, objects));
  EXPECT_FALSE(is_free({0.03, 0.02}, objects, 0.1));
}

} // namespace

} // namespace castor::spatial
