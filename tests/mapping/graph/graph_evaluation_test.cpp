#include "castor/mapping/graph/graph_evaluation.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::mapping::test {

namespace {

GraphNode place(double x, std::int64_t area) {
  GraphNode result;
  result.pose = {x, 0, 0};
  result.area = area;
  return result;
}

GraphNode gateway(double x, double width) {
  GraphNode result;
  result.kind = NodeKind::gateway;
  result.pose = {x, 0, 0};
  result.width = width;
  return result;
}

std::string room_of(const Point2& p) {
  return p.x < 5 ? "left" : "right";
}

TEST(GraphEvaluation, APerfectGraphHasAllDoorsAndRooms) {
  const std::vector<GraphNode> nodes{place(1, 0), place(3, 0), gateway(5, 0.9), place(7, 1)};
  const auto x = evaluate(nodes, room_of, {{"door", {5, 0}, 0.9}});
  EXPECT_EQ(x.places, 3U);
  EXPECT_EQ(x.rooms, 2U);
  EXPECT_EQ(x.areas, 2U);
  EXPECT_EQ(x.area_recall, 1);
  EXPECT_EQ(x.area_precision, 1);
  EXPECT_EQ(x.doors_found, 1U);
  EXPECT_TRUE(x.doors_missed.empty());
  EXPECT_TRUE(x.doors_invented.empty());
  EXPECT_EQ(x.door_error_most, 0);
}

TEST(GraphEvaluation, RoomsThatAreOneAreaCostPrecisionAndAreasWithinARoomRecall) {
  const auto merged = evaluate({place(1, 0), place(3, 0), place(7, 0), place(8, 0)}, room_of, {});
  EXPECT_EQ(merged.area_recall, 1);
  EXPECT_EQ(merged.area_precision, 0.5);
  const auto divided = evaluate({place(1, 0), place(2, 0), place(3, 2), place(7, 1)}, room_of, {});
  EXPECT_EQ(divided.area_recall, 0.75);
  EXPECT_EQ(divided.area_precision, 1);
}

TEST(GraphEvaluation, DoorsAreFoundMissedOrInvented) {
  const std::vector<TrueDoor> doors{{"found", {5, 0}, 0.9},
                                    {"missed", {8, 0}, 0.9},
                                    {"shut", {11, 0}, 0.9, false},
                                    {"unseen", {14, 0}, 0.9, true, false}};
  const auto x = evaluate({gateway(5.1, 0.8), gateway(5.2, 0.9), gateway(2, 0.9)}, room_of, doors);
  EXPECT_EQ(x.doors_found, 1U);
  EXPECT_EQ(x.doors_seen, 2U);
  EXPECT_EQ(x.doors_missed, std::vector<std::string>{"missed"});
  // The second one in a door, and one where there is none.
  EXPECT_EQ(x.doors_invented.size(), 2U);
  EXPECT_NEAR(x.door_error_most, 0.1, 1e-9);
  EXPECT_NEAR(x.width_error_median, 0.1, 1e-9);
}

TEST(GraphEvaluation, OfNothingIsNothing) {
  const auto x = evaluate({}, room_of, {});
  EXPECT_EQ(x.area_recall, 0);
  EXPECT_EQ(x.doors_found, 0U);
}

} // namespace

} // namespace castor::mapping::test
