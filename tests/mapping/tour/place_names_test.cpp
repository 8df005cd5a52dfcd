#include "castor/mapping/tour/place_names.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace castor::mapping::test {

namespace {

GraphNode node(std::int64_t id, double x, std::int64_t area) {
  GraphNode result;
  result.id = id;
  result.pose = {x, 0, 0};
  result.area = area;
  if (area < 0) {
    result.kind = NodeKind::gateway;
    result.width = 0.9;
  }
  return result;
}

/// A door between two areas.
const std::vector<GraphNode>& nodes() {
  static const std::vector<GraphNode> result{node(0, -1, 5), node(1, 0, -1), node(2, 1, 6)};
  return result;
}

using Named = std::vector<PlaceNames::Named>;

TEST(PlaceNames, AreThoseOfTheAreaWhereTheRobotIs) {
  PlaceNames names;
  EXPECT_TRUE(names.is_empty());
  names.add("kitchen", {1.5, 0.5});
  EXPECT_EQ(names.take_known({1, 0, 0}, {2, 6, 7}, nodes()), (Named{{6, "kitchen"}}));
  EXPECT_TRUE(names.take_known({1, 0, 0}, {2, 6, 7}, nodes()).empty());
}

TEST(PlaceNames, StayOnTheirSideOfADoorThatIsFoundLater) {
  PlaceNames names;
  names.add("kitchen", {1.5, 0.5});
  const std::vector<GraphNode> before{node(0, -1, 5)};
  EXPECT_EQ(names.take_known({0.5, 0, 0}, {0, 5, 3}, before), (Named{{5, "kitchen"}}));
  EXPECT_TRUE(names.take_moved(before).empty());
  // The door is there before any place behind it.
  const std::vector<GraphNode> door{node(0, -1, 5), node(1, 0, -1)};
  EXPECT_TRUE(names.take_moved(door).empty());
  const std::vector<PlaceNames::Moved> moved{{5, {6, "kitchen"}}};
  EXPECT_EQ(names.take_moved(nodes()), moved);
  EXPECT_TRUE(names.take_moved(nodes()).empty());
}

TEST(PlaceNames, OfTwoForOneAreaTheLastCounts) {
  PlaceNames names;
  for (const auto* name : {"kitchen", "office"}) {
    names.add(name, {1.5, 0.5});
    EXPECT_EQ(names.take_known({1, 0, 0}, {2, 6, 7}, nodes()), (Named{{6, name}}));
  }
  const std::vector<GraphNode> other{node(2, 1, 9)};
  const std::vector<PlaceNames::Moved> moved{{6, {9, "office"}}};
  EXPECT_EQ(names.take_moved(other), moved);
}

TEST(PlaceNames, WaitUntilTheRobotHasFollowedThroughTheDoor) {
  PlaceNames names;
  names.add("kitchen", {1.2, 0});
  // In the corridor, in the door, behind it but with no place of that room in the graph yet.
  EXPECT_TRUE(names.take_known({-0.4, 0, 0}, {0, 5, 3}, nodes()).empty());
  EXPECT_TRUE(names.take_known({0, 0, 0}, {1, 5, 4}, nodes()).empty());
  EXPECT_TRUE(names.take_known({0.3, 0, 0}, {0, 5, 5}, nodes()).empty());
  EXPECT_FALSE(names.is_empty());
  EXPECT_EQ(names.take_known({0.8, 0, 0}, {2, 6, 6}, nodes()), (Named{{6, "kitchen"}}));
}

TEST(PlaceNames, AreNotThoseOfPlacesFarAway) {
  PlaceNames names;
  names.add("kitchen", {1, 4});
  EXPECT_TRUE(names.take_known({1, 0, 0}, {2, 6, 7}, nodes()).empty());
  EXPECT_TRUE(names.take_known({1, 0, 0}, {-1, -1, 7}, nodes()).empty());
  EXPECT_FALSE(names.is_empty());
}

} // namespace

} // namespace castor::mapping::test
