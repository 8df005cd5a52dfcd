#include "castor/mapping/graph/graph_keeper.hpp"

#include "castor/mapping/graph/shortest_path.hpp"
#include "castor/tests/mapping/graph/two_rooms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace castor::mapping::test {

namespace {

/// Drives along a way and tells the keeper.
struct Drive {
  explicit Drive(const std::string& building = two_rooms()) : scanner(building) {}

  /// @param drift of the poses that the keeper is told
  void go(const std::vector<Point2>& way, const Pose2& drift = {}) {
    for (auto& truth : poses_along(way)) {
      poses.push_back(truth);
      const auto number = static_cast<std::int64_t>(poses.size()) - 1;
      scans.push_back(scanner.shared_scan(truth));
      const auto pose = compose(drift, truth);
      keeper.add(number, scans.back(), pose, pose);
      keeper.finish();
    }
  }

  std::set<std::int64_t> live_areas() const {
    std::set<std::int64_t> result;
    for (auto& [id, x] : keeper.graph().areas())
      if (x.merged_into < 0)
        result.insert(id);
    return result;
  }

  std::vector<GraphNode> gateways() const {
    std::vector<GraphNode> result;
    for (auto& [id, x] : keeper.graph().nodes())
      if (x.kind == NodeKind::gateway)
        result.push_back(x);
    return result;
  }

  Scanner scanner;
  GraphKeeper keeper;
  std::vector<Pose2> poses;
  std::vector<std::shared_ptr<const LaserScan>> scans;
};

std::vector<GraphNode> nodes_of(const GraphKeeper& keeper) {
  std::vector<GraphNode> result;
  for (auto& [id, x] : keeper.graph().nodes())
    result.push_back(x);
  return result;
}

std::vector<GraphEdge> edges_of(const GraphKeeper& keeper) {
  std::vector<GraphEdge> result;
  for (auto& [key, x] : keeper.graph().edges())
    result.push_back(x);
  return result;
}

std::vector<Area> areas_of(const GraphKeeper& keeper) {
  std::vector<Area> result;
  for (auto& [id, x] : keeper.graph().areas())
    result.push_back(x);
  return result;
}

TEST(GraphKeeper, PlacesAreAboutAMetreApart) {
  Drive drive;
  drive.go({{1, 1}, {1, 4}, {4, 4}, {4, 1}, {1, 1}});
  auto nodes = nodes_of(drive.keeper);
  std::erase_if(nodes, [](auto& x) { return x.kind == NodeKind::gateway; });
  EXPECT_GE(nodes.size(), 9U);
  EXPECT_LE(nodes.size(), 14U);
  for (auto& a : nodes)
    for (auto& b : nodes)
      EXPECT_TRUE(a.id == b.id || distance(a.pose, b.pose) > 0.9) << a.id << " " << b.id;
  // The way to the door, which was only seen, is longer.
  const auto is_place = [&](std::int64_t x) {
    return drive.keeper.graph().nodes().at(x).kind == NodeKind::place;
  };
  for (auto& [key, edge] : drive.keeper.graph().edges()) {
    if (is_place(key.first) && is_place(key.second)) {
      EXPECT_LT(edge.cost, 2) << key.first << " " << key.second;
    }
  }
  // Driving on among them adds nothing.
  drive.keeper.take_changes();
  drive.go({{1, 1}, {1, 3.8}});
  EXPECT_TRUE(drive.keeper.take_changes().nodes.empty());
}

TEST(GraphKeeper, RoomsAreAreasWithTheDoorBetween) {
  Drive drive;
  drive.go({{1, 2.5}, {8, 2.5}, {8, 4}, {8, 2.5}, {1.2, 2.5}});
  ASSERT_EQ(drive.gateways().size(), 1U);
  EXPECT_NEAR(drive.gateways()[0].pose.x, 5, 0.04);
  EXPECT_NEAR(drive.gateways()[0].pose.y, 2.5, 0.04);
  EXPECT_EQ(drive.live_areas().size(), 2U);
  for (auto& [id, x] : drive.keeper.graph().nodes()) {
    if (x.kind == NodeKind::place) {
      EXPECT_EQ(x.area == drive.keeper.position().area, x.pose.x < 5) << id << " " << x.pose.x;
    }
  }
  const auto edges = edges_of(drive.keeper);
  const auto nodes = nodes_of(drive.keeper);
  auto last = std::ranges::max_element(nodes, {}, [](auto& x) { return x.pose.y; });
  const auto way = shortest_way(edges, 0, last->id);
  ASSERT_FALSE(way.nodes.empty());
  EXPECT_EQ(std::ranges::count(way.nodes, drive.gateways()[0].id), 1);
}

TEST(GraphKeeper, ADoorThatWasOnlySeenIsConnectedWithTheSideItWasSeenFrom) {
  Drive drive;
  drive.go({{1, 2.5}, {3.5, 2.5}});
  ASSERT_EQ(drive.gateways().size(), 1U);
  EXPECT_EQ(drive.keeper.graph().neighbours(drive.gateways()[0].id).size(), 1U);
  EXPECT_EQ(drive.live_areas().size(), 1U);
}

TEST(GraphKeeper, ARoomWithoutADoorBetweenItsPartsIsOneArea) {
  // The wall ends a metre and a half before the other one.
  Drive drive("building test\nthickness 0.1\nwall 0 0 to 10 0 to 10 5 to 0 5 close\n"
              "wall 5 0 to 5 3.4\nroom hall at 1 1\nstart 1 2.5\n");
  drive.go({{1, 4.2}, {8, 4.2}, {8, 1}});
  EXPECT_TRUE(drive.gateways().empty());
  EXPECT_EQ(drive.live_areas().size(), 1U);
}

TEST(GraphKeeper, AnotherWayWithoutADoorMakesItOneArea) {
  Drive drive("building test\nthickness 0.1\nwall 0 0 to 10 0 to 10 5 to 0 5 close\n"
              "wall 5 0 to 5 3.4\ndoor between at 5 1.5 width 0.9\nroom hall at 1 1\n"
              "start 1 2.5\n");
  drive.go({{1, 1.5}, {8, 1.5}});
  ASSERT_EQ(drive.live_areas().size(), 2U);
  drive.go({{8, 1.5}, {8, 4.2}, {1, 4.2}, {1, 1.5}});
  EXPECT_EQ(drive.gateways().size(), 1U);
  EXPECT_EQ(drive.live_areas(), std::set<std::int64_t>{0});
  EXPECT_EQ(drive.keeper.graph().areas().at(1).merged_into, 0);
  EXPECT_EQ(drive.keeper.position().area, 0);
}

TEST(GraphKeeper, NodesFollowCorrectionsOfTheirKeyframes) {
  Drive drive;
  const Pose2 drift{0.5, -0.3, 0.2};
  drive.go({{1, 2.5}, {8, 2.5}}, drift);
  for (std::size_t i = 0; i < drive.poses.size(); ++i)
    drive.keeper.correct(static_cast<std::int64_t>(i), drive.poses[i]);
  drive.keeper.finish();
  for (auto& [id, x] : drive.keeper.graph().nodes())
    EXPECT_NEAR(x.pose.y, 2.5, 0.05) << id;
  ASSERT_EQ(drive.gateways().size(), 1U);
  EXPECT_NEAR(drive.gateways()[0].pose.x, 5, 0.07);
  EXPECT_EQ(drive.live_areas().size(), 2U);
}

TEST(GraphKeeper, GoesOnFromItsEntriesAsIfNothingHadBeen) {
  Drive drive;
  drive.go({{1, 2.5}, {6.5, 2.5}});
  GraphKeeper again;
  again.restore(nodes_of(drive.keeper), edges_of(drive.keeper), areas_of(drive.keeper),
                drive.keeper.position());
  for (std::size_t i = 0; i < drive.poses.size(); ++i)
    again.add(static_cast<std::int64_t>(i), drive.scans[i], drive.poses[i], drive.poses[i]);
  again.finish();
  EXPECT_TRUE(again.take_changes().empty());
  EXPECT_EQ(again.graph().nodes(), drive.keeper.graph().nodes());
  drive.keeper = std::move(again);
  drive.go({{6.5, 2.5}, {8.5, 2.5}, {1.2, 2.5}});
  EXPECT_EQ(drive.gateways().size(), 1U);
  EXPECT_EQ(drive.live_areas().size(), 2U);
}

TEST(GraphKeeper, NodesOfAKeyframeThatIsGoneMoveWithAnother) {
  Drive drive;
  drive.go({{1, 2.5}, {3, 2.5}});
  drive.keeper.remove(0);
  drive.keeper.finish();
  EXPECT_NE(drive.keeper.graph().nodes().at(0).keyframe, 0);
  EXPECT_NEAR(drive.keeper.graph().nodes().at(0).pose.x, 1, 0.01);
}

TEST(GraphKeeper, ARoomSegmentationConfirmsDoorsAtItsOpenings) {
  Drive drive;
  drive.go({{2, 2.5}, {2.1, 2.5}});
  ASSERT_TRUE(drive.gateways().empty());
  const auto room_at = [](const Point2& p) { return p.x < 5 ? 1 : 2; };
  // An opening somewhere else, or one that faces another way, says nothing.
  for (auto& other : {Line2{{5, 4}, {5, 5}}, Line2{{4.55, 2.5}, {5.45, 2.5}}}) {
    drive.keeper.reconcile({room_at, {other}});
    drive.keeper.finish();
    EXPECT_TRUE(drive.gateways().empty());
  }
  drive.keeper.reconcile({room_at, {{{5, 2.05}, {5, 2.95}}}});
  drive.keeper.finish();
  EXPECT_EQ(drive.gateways().size(), 1U);
}

TEST(GraphKeeper, OfDoubtedDoorsThoseStayThatTheRobotHasPassed) {
  Drive seen;
  seen.go({{1, 2.5}, {4.3, 2.5}});
  ASSERT_EQ(seen.gateways().size(), 1U);
  const RoomSegments one_room{[](const Point2&) { return 1; }, {}};
  seen.keeper.reconcile(one_room);
  seen.keeper.finish();
  EXPECT_TRUE(seen.gateways().empty());
  // Driving on, the robot passes it.
  seen.go({{4.3, 2.5}, {8, 2.5}});
  EXPECT_EQ(seen.gateways().size(), 1U);
  EXPECT_EQ(seen.live_areas().size(), 2U);
  seen.keeper.reconcile(one_room);
  seen.keeper.finish();
  EXPECT_EQ(seen.gateways().size(), 1U);
}

TEST(GraphKeeper, TheWayDrivenToADoorReplacesWaysFromWhereItWasSeen) {
  Drive drive;
  drive.go({{1, 2.5}, {8, 2.5}});
  ASSERT_EQ(drive.gateways().size(), 1U);
  const auto door = drive.gateways()[0].id;
  ASSERT_EQ(drive.keeper.graph().neighbours(door).size(), 2U);
  for (auto x : drive.keeper.graph().neighbours(door))
    EXPECT_LT(distance(drive.keeper.graph().nodes().at(x).pose, drive.gateways()[0].pose), 1.5);
}

} // namespace

} // namespace castor::mapping::test
