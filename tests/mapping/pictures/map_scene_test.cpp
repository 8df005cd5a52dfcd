#include "castor/mapping/pictures/map_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace castor::mapping {

namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

GraphNode node(std::int64_t id, double x, std::int64_t area) {
  GraphNode result;
  result.id = id;
  result.pose = {x, 0, 0};
  result.area = area;
  result.kind = area < 0 ? NodeKind::gateway : NodeKind::place;
  return result;
}

MapKnowledge knowledge() {
  MapKnowledge result;
  result.nodes = {node(1, 0, 0), node(2, 1, -1), node(3, 2, 1)};
  result.edges = {{1, 2, 1}, {2, 3, 1}, {3, 99, 1}};
  result.areas.resize(3);
  result.areas[1].id = 1;
  result.areas[1].label = "kitchen";
  result.areas[2].id = 2;
  result.areas[2].merged_into = 0;
  return result;
}

} // namespace

TEST(MapScene, IsEmptyOfNothing) {
  const auto scene = map_scene({});
  EXPECT_THAT(scene.tracks, IsEmpty());
  EXPECT_THAT(scene.marks, IsEmpty());
  EXPECT_EQ(scene.content, "");
}

TEST(MapScene, ColoursNodesByTheirAreas) {
  const auto scene = map_scene(knowledge());
  // The edge to a node that is not there is left out.
  EXPECT_THAT(scene.tracks, SizeIs(2));
  // Three nodes and two labels; the merged area has none.
  ASSERT_THAT(scene.marks, SizeIs(5));
  EXPECT_NE(scene.marks[0].red, scene.marks[2].red);
  EXPECT_EQ(scene.marks[3].text, "area 0");
  EXPECT_EQ(scene.marks[4].text, "kitchen");
  EXPECT_EQ(scene.marks[4].red, scene.marks[2].red);
  EXPECT_EQ(scene.content, "3 nodes of 2 areas");
}

TEST(MapScene, AreasBehindAGatewayDifferInColourWhateverTheirIds) {
  for (std::int64_t first = 0; first < 10; ++first)
    for (std::int64_t second = first + 1; second < 20; ++second) {
      MapKnowledge x;
      // Others have the colours in between.
      for (std::int64_t i = 0; i <= second; ++i)
        x.nodes.push_back(node(i, static_cast<double>(i), i));
      x.nodes.push_back(node(100, 0.5, -1));
      x.edges = {{first, 100, 1}, {second, 100, 1}};
      const auto marks = map_scene(x).marks;
      const auto& a = marks[static_cast<std::size_t>(first)];
      const auto& b = marks[static_cast<std::size_t>(second)];
      EXPECT_FALSE(a.red == b.red && a.green == b.green && a.blue == b.blue)
        << first << " " << second;
    }
}

TEST(MapScene, LabelsAnAreaAtThePlaceNearestToItsMiddle) {
  auto x = knowledge();
  x.areas[0].x = -5;
  x.areas[0].y = 7;
  const auto label = map_scene(x).marks[3];
  EXPECT_EQ(label.text, "area 0");
  EXPECT_EQ(label.place.x, 0);
  EXPECT_EQ(label.place.y, 0);
}

TEST(MapScene, ShowsFrontiersPeopleAndThePlannedPath) {
  MapKnowledge x;
  x.trajectory = {{0, 0, 0}, {1, 0, 0}};
  x.people[7] = {{2, 0, 0}, {2, 1, 0}};
  x.explorations.resize(1);
  x.explorations[0].frontiers = {{1, 1, 1, FrontierState::open, ""},
                                 {2, 2, 1, FrontierState::unreachable, "too narrow"}};
  x.movements.resize(2);
  x.movements[1].path = {{0, 0, 0}, {1, 1, 0}};
  const auto scene = map_scene(x);
  EXPECT_THAT(scene.tracks, SizeIs(3));
  ASSERT_THAT(scene.marks, SizeIs(3));
  EXPECT_EQ(scene.marks[0].text, "person 7");
  EXPECT_NE(scene.marks[1].red, scene.marks[2].red);
  EXPECT_EQ(scene.content, "trajectory, 1 people, 2 frontiers, planned path");
  EXPECT_EQ(map_picture({}, scene.tracks, {}, scene.marks).substr(1, 3), "PNG");
}

} // namespace castor::mapping
