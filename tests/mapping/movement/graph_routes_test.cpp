#include "castor/mapping/movement/graph_routes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace castor::mapping {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

GraphNode node(std::int64_t id, double x, double y, std::int64_t area) {
  GraphNode result;
  result.id = id;
  result.kind = area < 0 ? NodeKind::gateway : NodeKind::place;
  result.pose = {x, y, 0};
  result.area = area;
  return result;
}

/// Two rooms with a door between them: 0 and 1, the door 2, then 3 and 4. Area 7 was merged into 5.
GraphRoutes two_rooms() {
  Area left;
  left.id = 5;
  left.x = 0.4;
  Area right;
  right.id = 6;
  right.x = 4;
  right.y = 0.9;
  Area merged;
  merged.id = 7;
  merged.merged_into = 5;
  return {
    {node(0, 0, 0, 5), node(1, 1, 0, 5), node(2, 2, 0, -1), node(3, 3, 0, 6), node(4, 4, 1, 6)},
    {{0, 1, 1}, {1, 2, 1}, {2, 3, 1}, {3, 4, 1.5}},
    {left, right, merged}};
}

double straight(const Point2& from, const Point2& to) {
  return distance(from, to);
}

TEST(GraphRoutes, FollowsTheGraph) {
  EXPECT_THAT(two_rooms().between({0, -0.5}, {4, 1.5}, straight),
              ElementsAre(Point2{0, 0}, Point2{1, 0}, Point2{2, 0}, Point2{3, 0}, Point2{4, 1}));
}

TEST(GraphRoutes, BeginsAndEndsAtNodesThatCanBeDrivenTo) {
  // Node 1 is the nearest, behind a wall.
  const auto way = [](const Point2& from, const Point2& to) {
    return to.x == 1 ? std::numeric_limits<double>::infinity() : distance(from, to);
  };
  EXPECT_THAT(two_rooms().between({0.9, -0.5}, {3, 0}, way),
              ElementsAre(Point2{2, 0}, Point2{3, 0}));
  const auto none = [](const Point2&, const Point2&) {
    return std::numeric_limits<double>::infinity();
  };
  EXPECT_THAT(two_rooms().between({0, 0}, {4, 1}, none), IsEmpty());
  EXPECT_THAT(GraphRoutes({}, {}, {}).between({0, 0}, {4, 1}, straight), IsEmpty());
}

TEST(GraphRoutes, FindsNodesAndTheMiddlesOfAreas) {
  EXPECT_EQ(two_rooms().node(4).place, (Point2{4, 1}));
  EXPECT_THAT(two_rooms().node(9).reason, HasSubstr("no node 9; it has 5 nodes"));
  EXPECT_EQ(two_rooms().area(6).place, (Point2{4, 1}));
  EXPECT_EQ(two_rooms().area(7).place, (Point2{0, 0})) << "it was merged into area 5";
  EXPECT_THAT(two_rooms().area(8).reason, HasSubstr("no place in an area 8"));
  EXPECT_THAT(two_rooms().gateways(), ElementsAre(Point2{2, 0}));
}

TEST(GraphRoutes, FindsAreasByTheirNames) {
  Area small;
  small.id = 5;
  small.label = "kitchen";
  small.places = 1;
  Area large = small;
  large.id = 6;
  large.places = 2;
  Area merged = large;
  merged.id = 7;
  merged.merged_into = 5;
  merged.places = 9;
  const GraphRoutes routes{
    {node(0, 0, 0, 5), node(3, 3, 0, 6), node(4, 4, 1, 6)}, {}, {small, large, merged}};
  EXPECT_EQ(routes.area_named("kitchen").place, (Point2{3, 0}));
  EXPECT_THAT(routes.area_named("office").reason,
              HasSubstr("no area of the navigation graph is called office; there are: kitchen"));
  EXPECT_THAT(two_rooms().area_named("office").reason, HasSubstr("none has a name"));
}

} // namespace

} // namespace castor::mapping
