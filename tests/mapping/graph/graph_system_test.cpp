// The navigation graph in a running system.

#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/tests/mapping/graph/two_rooms.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace castor::mapping::test {

/// Entry: number of changes by when the robot's position was that of a keyframe; by its number.
struct GraphHistory {
  std::vector<std::int64_t> changes;
};
CASTOR_REFLECT(GraphHistory, changes)

namespace {

/// Drives through both rooms; later, as its options say, names the first area, corrects the path,
/// and drives on.
class Guide final : public UnmanagedComponent {
  void start() override {
    on_change(changed<RobotArea>(), [](const ChangeEvent&) {});
  }

  void run() override {
    go({{1, 2.5}, {8, 2.5}});
    wait_for_graph();
    label();
    if (corrects_)
      correct();
    // Time for the test to crash the graph.
    if (!goes_on_ || !sleep_for(std::chrono::minutes{1}))
      return;
    go({{8, 2.5}, {8, 3.9}});
  }

  void wait_for_graph() {
    while (is_running()) {
      const auto positions = read_all<RobotArea>();
      if (!positions.empty() &&
          positions[0]->keyframe + 1 == static_cast<std::int64_t>(poses_.size()))
        return;
      wait_for_changes();
    }
  }

  void go(const std::vector<Point2>& way) {
    for (auto& pose : poses_along(way)) {
      Keyframe x;
      x.number = static_cast<std::int64_t>(poses_.size());
      x.time = 300'000 * x.number;
      x.local_pose = pose;
      x.scan = scanner_.scan(pose, {}, x.time);
      add(here("keyframe " + std::to_string(x.number)), x);
      poses_.push_back(pose);
    }
  }

  void correct() {
    GraphPoses x;
    x.version = 1;
    for (auto& pose : poses_)
      x.poses.push_back(compose({10, 0, 0}, pose));
    x.local_frame = {10, 0, 0};
    put(here("graph"), x);
  }

  void label() {
    auto area = *read<Area>(here("area-0"));
    area.label = "kitchen";
    overwrite(here("area-0"), area);
  }

  Option<bool> corrects_{this, "corrects", false, "whether it corrects the path"};
  Option<bool> goes_on_{this, "goes-on", false, "whether it drives on after a minute"};

  Scanner scanner_{two_rooms()};
  std::vector<Pose2> poses_;
};
CASTOR_COMPONENT(Guide, "adds the keyframes of a way")

/// Counts nodes and edges that come and go, and changes of areas.
class GraphWitness final : public UnmanagedComponent {
  void start() override {
    const auto count = [this](const ChangeEvent&) { ++changes_; };
    // Overwrites are corrections of some centimetres.
    on_change(added<GraphNode>(), count);
    on_change(deleted<GraphNode>(), count);
    on_change(added<GraphEdge>(), count);
    on_change(deleted<GraphEdge>(), count);
    on_change(changed<Area>().where(field(&Area::label) == ""), count);
    on_change(changed<RobotArea>(), [this](const ChangeEvent& event) {
      const auto keyframe = read<RobotArea>(event.address)->keyframe;
      history_.changes.resize(static_cast<std::size_t>(keyframe) + 1, changes_);
      put(here("history"), history_);
    });
  }

  std::int64_t changes_ = 0;
  GraphHistory history_;
};
CASTOR_COMPONENT(GraphWitness, "counts changes of the graph")

std::string cast_with(const std::string& options, const std::string& builder_options = {}) {
  return "SUBARCHITECTURE mapping\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n"
         "CPP UM guide Guide " +
         options + "\nCPP UM witness GraphWitness\nCPP UM graph NavigationGraphBuilder" +
         builder_options + "\n";
}

template <class T>
std::vector<T> all(TestSystem& system) {
  std::vector<T> result;
  for (auto& entry : system.system().entries("mapping"))
    if (auto x = entry->value.as<T>())
      result.push_back(*x);
  return result;
}

std::size_t areas_with_places(TestSystem& system) {
  const auto areas = all<Area>(system);
  return static_cast<std::size_t>(
    std::ranges::count_if(areas, [](auto& x) { return x.places > 0; }));
}

TEST(NavigationGraphBuilder, WritesAnEntryForEachNodeEdgeAndArea) {
  TestSystem system{cast_with(""), {.simulated_time = true}};
  system.expect_entry("Area in mapping where label == \"kitchen\"");
  const auto nodes = all<GraphNode>(system);
  EXPECT_GE(nodes.size(), 7U);
  EXPECT_EQ(std::ranges::count(nodes, NodeKind::gateway, &GraphNode::kind), 1);
  EXPECT_EQ(areas_with_places(system), 2U);
  EXPECT_GE(all<GraphEdge>(system).size(), nodes.size() - 1);
  for (auto& entry : system.system().entries("mapping"))
    if (auto x = entry->value.as<GraphNode>()) {
      EXPECT_EQ(entry->address.id, "node-" + std::to_string(x->id));
    } else if (auto edge = entry->value.as<GraphEdge>()) {
      EXPECT_EQ(entry->address.id,
                "edge-" + std::to_string(edge->a) + "-" + std::to_string(edge->b));
    }
}

TEST(NavigationGraphBuilder, MovesEntriesWithTheCorrectedKeyframes) {
  TestSystem system{cast_with("--corrects true"), {.simulated_time = true}};
  system.wait_until("the moved graph", [&] {
    const auto nodes = all<GraphNode>(system);
    return !nodes.empty() && std::ranges::all_of(nodes, [](auto& x) { return x.pose.x > 10.9; });
  });
  // What people have named keeps its name, and moves, too.
  system.wait_until("the moved areas", [&] {
    const auto areas = all<Area>(system);
    return std::ranges::all_of(areas, [](auto& x) { return x.x > 10; }) &&
           std::ranges::count(areas, "kitchen", &Area::label) == 1;
  });
  system.expect_nobody_else_down({});
}

TEST(NavigationGraphBuilder, GoesOnFromItsEntriesAfterACrash) {
  TestSystem system{cast_with("--goes-on true"), {.simulated_time = true}};
  system.expect_entry("Area in mapping where label == \"kitchen\"");
  const auto before = all<GraphNode>(system);
  system.inject("crash graph");
  system.expect_back("graph");
  system.expect_entry("RobotArea in mapping from graph where keyframe > 50",
                      std::chrono::minutes{2});
  const auto after = all<GraphNode>(system);
  EXPECT_GE(after.size(), before.size() + 1);
  for (auto& x : before) {
    const auto same = std::ranges::find(after, x.id, &GraphNode::id);
    ASSERT_NE(same, after.end()) << x.id;
    EXPECT_EQ(same->kind, x.kind) << x.id;
    EXPECT_EQ(same->area, x.area) << x.id;
  }
  EXPECT_EQ(std::ranges::count(after, NodeKind::gateway, &GraphNode::kind), 1);
  EXPECT_EQ(areas_with_places(system), 2U);
  system.expect_nobody_else_down({"graph"});
}

TEST(NavigationGraphBuilder, PublishesNothingWhileItTakesUpTheKeyframesAgain) {
  // A step is one keyframe.
  TestSystem system{cast_with("--goes-on true", " --slice 0ms"), {.simulated_time = true}};
  system.expect_entry("Area in mapping where label == \"kitchen\"");
  system.advance(std::chrono::seconds{1});
  const auto before = all<GraphHistory>(system).front();
  system.inject("crash graph");
  system.expect_back("graph");
  const auto known = before.changes.size();
  system.wait_until(
    "the first position after the restart",
    [&] { return all<GraphHistory>(system).front().changes.size() > known; },
    std::chrono::minutes{2});
  // The first new keyframe makes no node.
  EXPECT_EQ(all<GraphHistory>(system).front().changes[known], before.changes.back());
}

} // namespace

} // namespace castor::mapping::test
