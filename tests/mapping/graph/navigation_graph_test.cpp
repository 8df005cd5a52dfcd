#include "castor/mapping/graph/navigation_graph.hpp"
#include "castor/mapping/graph/segments.hpp"
#include "castor/mapping/graph/shortest_path.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>
#include <vector>

namespace castor::mapping::test {

namespace {

/// Places 0 - 1 - gateway 2 - 3 - 4, a metre apart.
NavigationGraph two_areas() {
  NavigationGraph graph;
  for (int i = 0; i < 5; ++i)
    graph.add(i == 2 ? NodeKind::gateway : NodeKind::place, {1.0 * i, 0, 0}, i, {1.0 * i, 0, 0},
              i == 2 ? 0.9 : 0);
  for (int i = 0; i + 1 < 5; ++i)
    graph.connect(i, i + 1, 1);
  graph.update_areas();
  return graph;
}

std::vector<GraphEdge> edges_of(const NavigationGraph& graph) {
  std::vector<GraphEdge> result;
  for (auto& [key, x] : graph.edges())
    result.push_back(x);
  return result;
}

TEST(NavigationGraph, AreasAreSeparatedByGateways) {
  auto graph = two_areas();
  EXPECT_EQ(graph.nodes().at(0).area, graph.nodes().at(1).area);
  EXPECT_EQ(graph.nodes().at(3).area, graph.nodes().at(4).area);
  EXPECT_NE(graph.nodes().at(1).area, graph.nodes().at(3).area);
  EXPECT_EQ(graph.nodes().at(2).area, -1);
  ASSERT_EQ(graph.areas().size(), 2U);
  EXPECT_EQ(graph.areas().at(0).places, 2);
  EXPECT_NEAR(graph.areas().at(0).x, 0.5, 1e-9);
}

TEST(NavigationGraph, PlacesOnOneSideOfAGatewayAreOfOneArea) {
  auto graph = two_areas();
  const auto beside = graph.add(NodeKind::place, {1.2, 2, 0}, 5, {1.2, 2, 0});
  const auto behind = graph.add(NodeKind::place, {2.8, -2, 0}, 6, {2.8, -2, 0});
  const auto other = graph.add(NodeKind::gateway, {1, 4, 0}, 7, {1, 4, 0}, 0.9);
  const auto beyond = graph.add(NodeKind::place, {0.5, 5, 0}, 8, {0.5, 5, 0});
  graph.connect(2, beside, 1);
  graph.connect(2, behind, 1);
  // From gateway to gateway.
  graph.connect(2, other, 1);
  graph.connect(other, beyond, 1);
  graph.update_areas();
  EXPECT_EQ(graph.nodes().at(beside).area, graph.nodes().at(0).area);
  EXPECT_EQ(graph.nodes().at(behind).area, graph.nodes().at(4).area);
  // The first gateway is in front of the other one, and this one's far side is another area.
  EXPECT_NE(graph.nodes().at(beyond).area, graph.nodes().at(0).area);
  EXPECT_NE(graph.nodes().at(beyond).area, graph.nodes().at(4).area);
}

TEST(NavigationGraph, AGatewayThatIsNoneMergesItsAreasAndKeepsTheEntryOfTheOther) {
  auto graph = two_areas();
  graph.label(1, "kitchen");
  graph.take_changes();
  graph.make_place(2);
  graph.update_areas();
  for (auto& [id, x] : graph.nodes())
    EXPECT_EQ(x.area, 0) << id;
  EXPECT_EQ(graph.areas().at(1).merged_into, 0);
  EXPECT_EQ(graph.areas().at(1).places, 0);
  EXPECT_EQ(graph.areas().at(0).label, "kitchen");
  const auto changes = graph.take_changes();
  EXPECT_EQ(changes.nodes, (std::set<std::int64_t>{2, 3, 4}));
  EXPECT_EQ(changes.areas, (std::set<std::int64_t>{0, 1}));
  EXPECT_TRUE(changes.edges.empty());
}

TEST(NavigationGraph, AreasThatWereMergedBeforeFollow) {
  auto graph = two_areas();
  const auto gateway = graph.add(NodeKind::gateway, {5, 0, 0}, 5, {5, 0, 0}, 0.9);
  const auto place = graph.add(NodeKind::place, {6, 0, 0}, 6, {6, 0, 0});
  graph.connect(4, gateway, 1);
  graph.connect(gateway, place, 1);
  graph.update_areas();
  ASSERT_EQ(graph.nodes().at(place).area, 2);
  graph.connect(4, place, 1);
  graph.update_areas();
  EXPECT_EQ(graph.areas().at(2).merged_into, 1);
  graph.connect(1, 3, 1);
  graph.update_areas();
  EXPECT_EQ(graph.areas().at(1).merged_into, 0);
  EXPECT_EQ(graph.areas().at(2).merged_into, 0);
}

TEST(NavigationGraph, AnAreaThatADoorDividesKeepsItsIdWhereMostOfItIs) {
  NavigationGraph graph;
  for (int i = 0; i < 5; ++i)
    graph.add(NodeKind::place, {1.0 * i, 0, 0}, i, {1.0 * i, 0, 0});
  for (int i = 0; i + 1 < 5; ++i)
    graph.connect(i, i + 1, 1);
  graph.update_areas();
  graph.disconnect(1, 2);
  graph.update_areas();
  EXPECT_EQ(graph.nodes().at(2).area, 0);
  EXPECT_EQ(graph.nodes().at(4).area, 0);
  EXPECT_EQ(graph.nodes().at(0).area, 1);
}

TEST(NavigationGraph, OneMoreNodeTouchesOnlyItsOwnEntries) {
  auto graph = two_areas();
  graph.take_changes();
  const auto id = graph.add(NodeKind::place, {5, 0, 0}, 5, {5, 0, 0});
  graph.connect(4, id, 1);
  graph.update_areas();
  const auto changes = graph.take_changes();
  EXPECT_EQ(changes.nodes, std::set<std::int64_t>{id});
  EXPECT_EQ(changes.edges, (std::set<EdgeKey>{{4, id}}));
  EXPECT_EQ(changes.areas, std::set<std::int64_t>{1});
}

TEST(NavigationGraph, MovesLessThanTheToleranceAreNone) {
  auto graph = two_areas();
  graph.take_changes();
  graph.move(0, {0.001, 0, 0});
  graph.update_areas();
  EXPECT_TRUE(graph.take_changes().empty());
  graph.move(0, {-1, 0, 0});
  graph.update_areas();
  const auto changes = graph.take_changes();
  EXPECT_EQ(changes.nodes, std::set<std::int64_t>{0});
  EXPECT_EQ(changes.edges, (std::set<EdgeKey>{{0, 1}}));
  EXPECT_NEAR(graph.edges().at({0, 1}).cost, 2, 1e-9);
}

TEST(NavigationGraph, NarrowEdgesCostMore) {
  auto graph = two_areas();
  graph.connect(0, 4, 0.25);
  EXPECT_NEAR(graph.edges().at({0, 4}).cost, 4 * 1.5, 1e-9);
}

TEST(NavigationGraph, GoesOnFromItsEntries) {
  const auto graph = two_areas();
  std::vector<GraphNode> nodes;
  for (auto& [id, x] : graph.nodes())
    nodes.push_back(x);
  std::vector<Area> areas;
  for (auto& [id, x] : graph.areas())
    areas.push_back(x);
  auto edges = edges_of(graph);
  edges.push_back({4, 77, 1});
  NavigationGraph again;
  again.restore(nodes, edges, areas);
  again.update_areas();
  EXPECT_EQ(again.nodes(), graph.nodes());
  EXPECT_EQ(again.edges(), graph.edges());
  EXPECT_EQ(again.areas(), graph.areas());
  const auto changes = again.take_changes();
  EXPECT_EQ(changes.edges, (std::set<EdgeKey>{{4, 77}}));
  EXPECT_TRUE(changes.nodes.empty());
  EXPECT_EQ(again.add(NodeKind::place, {}, 0, {}), 5);
}

TEST(NavigationGraph, AreasAreTheConnectedPlacesWhateverHappens) {
  EXPECT_TRUE(rc::check([] {
    NavigationGraph graph;
    for (int i = 0; i < 12; ++i)
      graph.add(*rc::gen::inRange(0, 4) == 0 ? NodeKind::gateway : NodeKind::place, {1.0 * i, 0, 0},
                i, {1.0 * i, 0, 0});
    for (int step = 0; step < 40; ++step) {
      const std::int64_t a = *rc::gen::inRange(0, 12);
      const std::int64_t b = *rc::gen::inRange(0, 12);
      if (*rc::gen::arbitrary<bool>())
        graph.connect(a, b, 1);
      else
        graph.disconnect(a, b);
      if (step == 20 && graph.nodes().at(a).kind == NodeKind::gateway)
        graph.make_place(a);
      graph.update_areas();
      // By repeated spreading, as a model, of places, of gateways' fronts and of their backs. All
      // face along the line that they are on.
      std::vector<std::int64_t> group(36);
      for (std::size_t i = 0; i < 36; ++i)
        group[i] = static_cast<std::int64_t>(i);
      auto is_place = [&](std::int64_t x) { return graph.nodes().at(x).kind == NodeKind::place; };
      auto end_of = [&](std::int64_t node, std::int64_t from) -> std::int64_t& {
        return group[static_cast<std::size_t>(is_place(node) ? node
                                              : from > node  ? node + 12
                                                             : node + 24)];
      };
      for (int round = 0; round < 36; ++round)
        for (auto& [key, edge] : graph.edges()) {
          auto& x = end_of(key.first, key.second);
          auto& y = end_of(key.second, key.first);
          x = y = std::min(x, y);
        }
      for (std::int64_t i = 0; i < 12; ++i) {
        const auto area = graph.nodes().at(i).area;
        RC_ASSERT((is_place(i) == (area >= 0)));
        RC_ASSERT((area < 0 || graph.areas().at(area).merged_into < 0));
        for (std::int64_t k = 0; k < 12; ++k)
          if (is_place(i) && is_place(k))
            RC_ASSERT(((area == graph.nodes().at(k).area) ==
                       (group[static_cast<std::size_t>(i)] == group[static_cast<std::size_t>(k)])));
      }
      for (auto& [id, area] : graph.areas())
        RC_ASSERT(((area.merged_into >= 0) == (area.places == 0)));
    }
  }));
}

TEST(ShortestWay, IsTheCheapestAndEmptyIfThereIsNone) {
  const std::vector<GraphEdge> edges{{0, 1, 1}, {1, 2, 1}, {0, 2, 5}, {2, 3, 1}, {5, 6, 1}};
  const auto way = shortest_way(edges, 0, 3);
  EXPECT_EQ(way.nodes, (std::vector<std::int64_t>{0, 1, 2, 3}));
  EXPECT_NEAR(way.cost, 3, 1e-9);
  EXPECT_TRUE(shortest_way(edges, 0, 6).nodes.empty());
  EXPECT_EQ(shortest_way(edges, 4, 4).nodes, std::vector<std::int64_t>{4});
}

TEST(ShortestWay, IsThatOfAllPairs) {
  EXPECT_TRUE(rc::check([] {
    const auto edges = *rc::gen::container<std::vector<GraphEdge>>(rc::gen::apply(
      [](std::int64_t a, std::int64_t b, int cost) {
        return GraphEdge{a, b, static_cast<double>(cost)};
      },
      rc::gen::inRange<std::int64_t>(0, 6), rc::gen::inRange<std::int64_t>(0, 6),
      rc::gen::inRange(1, 9)));
    // R. W. Floyd, "Algorithm 97: shortest path", 1962.
    constexpr double never = 1e9;
    double costs[6][6];
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        costs[a][b] = a == b ? 0 : never;
    for (auto& x : edges) {
      costs[x.a][x.b] = std::min(costs[x.a][x.b], x.cost);
      costs[x.b][x.a] = std::min(costs[x.b][x.a], x.cost);
    }
    for (int k = 0; k < 6; ++k)
      for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b)
          costs[a][b] = std::min(costs[a][b], costs[a][k] + costs[k][b]);
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b < 6; ++b) {
        const auto way = shortest_way(edges, a, b);
        RC_ASSERT(way.nodes.empty() == (costs[a][b] >= never));
        if (!way.nodes.empty())
          RC_ASSERT(way.cost == costs[a][b]);
      }
    }
  }));
}

TEST(Segments, CrossAndDistance) {
  EXPECT_TRUE(cross({{0, 0}, {2, 2}}, {{0, 2}, {2, 0}}));
  EXPECT_FALSE(cross({{0, 0}, {1, 0}}, {{2, -1}, {2, 1}}));
  EXPECT_FALSE(cross({{0, 0}, {1, 0}}, {{0.2, 0}, {0.8, 0}}));
  EXPECT_NEAR(distance(Line2{{0, 0}, {2, 0}}, {1, 1}), 1, 1e-9);
  EXPECT_NEAR(distance(Line2{{0, 0}, {2, 0}}, {5, 4}), 5, 1e-9);
}

} // namespace

} // namespace castor::mapping::test
