// The components of maps, in a running system.

#include "castor/actors/component/option.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/grid/tile_codec.hpp"
#include "castor/mapping/map_components/keyframe_poses.hpp"
#include "castor/mapping/map_components/types.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/octree/occupancy_octree.hpp"
#include "castor/mapping/octree/types.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/tests/mapping/grid/box_room.hpp"
#include "castor/tests/mapping/map_components/mapping_system.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace castor::mapping::test {

/// What the asker has been told.
struct ToldAnswers {
  RayEnd ray;
  BoxOccupancy box;
  PointOccupancy point;
  std::string problem;
};
CASTOR_REFLECT(ToldAnswers, ray, box, point, problem)

/// Where the asker is to ask.
struct AskingPlace {
  geometry::Point3 point;
};
CASTOR_REFLECT(AskingPlace, point)

namespace {

using castor::test::TemporaryFolder;

constexpr BoxRoom feeder_room{-2.02, 3.02, -1.52, 2.52};

const std::vector<Pose2>& true_poses() {
  static const std::vector<Pose2> result{{0, 0, 0}, {0.5, 0.2, 0.4}, {1, 0.5, 1}};
  return result;
}

/// Adds keyframes whose path has drifted, and then the corrected poses of the first two.
class KeyframeFeeder final : public UnmanagedComponent {
  void run() override {
    if (!read_all<Keyframe>().empty())
      return;
    auto& poses = true_poses();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      Keyframe x;
      x.number = static_cast<std::int64_t>(i);
      x.time = 1'000'000 * x.number;
      // By drift, they are in a frame that is turned.
      x.local_pose = compose({0.3, 0.1, 0.2}, poses[i]);
      x.scan = feeder_room.scan(poses[i], 360);
      add(here("keyframe " + std::to_string(i)), x);
    }
    Constraint edge;
    edge.to = 1;
    edge.pose = between(poses[0], poses[1]);
    edge.covariance = {0.01, 0, 0, 0.01, 0, 0.001};
    add(edge);
    GraphPoses graph;
    graph.version = 1;
    graph.poses = {poses[0], poses[1]};
    graph.local_frame = inverse({0.3, 0.1, 0.2});
    add(here("graph"), graph);
  }
};
CASTOR_COMPONENT(KeyframeFeeder, "adds keyframes of a room")

/// Asks the octree, when it is told to by an entry, and notes the answers.
class OctreeAsker final : public UnmanagedComponent {
  void start() override {
    on_change(added<AskingPlace>(), [this](const ChangeEvent& event) {
      auto point = read<AskingPlace>(event.address)->point;
      ToldAnswers told;
      told.ray = call<AskRay, RayEnd>(
        subarchitecture(),
        {.origin = point, .direction = {1, 0, 0}, .max_range = 10, .stops_at_unknown = false});
      told.box = call<AskBox, BoxOccupancy>(subarchitecture(), {{point, {0.3, 0.3, 0.01}, {}}});
      told.point = call<AskPoint, PointOccupancy>(subarchitecture(), {{50, 50, 0.3}});
      try {
        call<AskRay, RayEnd>(subarchitecture(), {point, {0, 0, 0}, 10, false});
      } catch (const CallException& e) {
        told.problem = e.what();
      }
      add(told);
    });
  }
};
CASTOR_COMPONENT(OctreeAsker, "asks the octree")

/// Tells the asker where to ask, once the octree has the corrected poses: the wall of the room is
/// where it should be.
class PointTeller final : public UnmanagedComponent {
  void start() override {
    // Each wakes run().
    on_change(added<OctreeBlock>(), [](const ChangeEvent&) {});
    on_change(overwritten<OctreeBlock>(), [](const ChangeEvent&) {});
  }

  void run() override {
    while (is_running()) {
      auto end = call<AskRay, RayEnd>(subarchitecture(), {{0.1, 0.1, 0.32}, {1, 0, 0}, 10, false});
      if (std::abs(end.point.x - feeder_room.right) < 0.1 && !read_all<GraphPoses>().empty())
        break;
      wait_for_changes();
    }
    add(AskingPlace{{0.1, 0.1, 0.32}});
  }
};
CASTOR_COMPONENT(PointTeller, "says where to ask")

/// Asks the exporter.
class ExportAsker final : public UnmanagedComponent {
  void run() override {
    auto files = call<ExportMap, ExportedMap>(subarchitecture(), {folder_.get()});
    add(files);
  }

  Option<std::string> folder_{this, "folder", "", "for the files"};
};
CASTOR_COMPONENT(ExportAsker, "asks for files")

/// The map of the corrected poses, by the grid alone.
CellMap expected_map() {
  OccupancyGrid grid;
  for (auto& x : true_poses())
    grid.insert(feeder_room.scan(x, 360), x);
  return cell_map(grid);
}

/// Share of the cells that are equal, both maps being placed by their origins.
bool is_nearly(const CellMap& map, const CellMap& expected) {
  if (map.columns != expected.columns || map.rows != expected.rows)
    return false;
  int differ = 0;
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    differ += std::abs(map.cells[i] - expected.cells[i]) > 20;
  // Corrected poses have rounding errors, which move the end of some beams by a cell.
  return differ < static_cast<int>(map.cells.size()) / 50;
}

TEST(GridBuilder, KeepsTheGridOfTheCorrectedPosesAlsoAfterACrash) {
  TestSystem system{cast_with("CPP UM feeder KeyframeFeeder\n"
                              "CPP UM grid GridBuilder\n")};
  auto has_map = [&] { return is_nearly(cell_map(all<GridTile>(system)), expected_map()); };
  system.wait_until("the grid of the corrected poses", has_map);
  EXPECT_GT(all<GridTile>(system).size(), 4U);
  system.inject("crash grid");
  system.expect_back("grid");
  system.wait_until("the grid after the restart", has_map);
  system.expect_nobody_else_down({"grid"});
}

TEST(OctreeBuilder, AnswersWhatIsAsked) {
  TestSystem system{cast_with(
    "CPP UM feeder KeyframeFeeder\n"
    "CPP UM octree OctreeBuilder --rebuild-period 20ms --voxel-size 0.05 --laser-height 0.32\n"
    "CPP UM asker OctreeAsker\n"
    "CPP UM told PointTeller\n")};
  system.expect_entry("ToldAnswers in mapping");
  auto told = all<ToldAnswers>(system).front();
  EXPECT_EQ(told.ray.met, Occupancy::occupied);
  EXPECT_NEAR(told.ray.point.x, feeder_room.right, 0.1);
  EXPECT_EQ(told.box.occupancy, Occupancy::free);
  EXPECT_EQ(told.point.occupancy, Occupancy::unknown);
  EXPECT_NE(told.problem.find("a ray needs finite numbers"), std::string::npos) << told.problem;
  EXPECT_GT(all<OctreeBlock>(system).size(), 4U);
}

/// Whether the blocks have nearly the voxels of an octree of the corrected poses.
bool are_nearly_expected(const std::vector<OctreeBlock>& blocks) {
  OccupancyOctree expected{{.voxel_size = 0.05}};
  for (auto& x : true_poses())
    expected.insert(cloud_of(feeder_room.scan(x, 360), x, 0.32));
  std::map<BlockIndex, BlockVoxels> voxels;
  for (auto& x : blocks)
    voxels[{x.x, x.y, x.z}] = decode_tile(x.bytes);
  std::size_t known = 0;
  std::size_t differ = 0;
  auto indices = expected.blocks();
  for (auto& [index, x] : voxels)
    indices.insert(index);
  for (auto& index : indices) {
    auto wanted = expected.block(index);
    auto found = voxels.find(index);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      auto x = found == voxels.end() ? unknown_cell : found->second[i];
      known += wanted[i] != unknown_cell;
      differ += x != wanted[i];
    }
  }
  // Corrected poses have rounding errors, which move the end of some beams by a voxel.
  return differ < known / 50;
}

TEST(OctreeBuilder, KeepsTheOctreeOfTheCorrectedPosesAlsoAfterACrash) {
  TestSystem system{cast_with("CPP UM feeder KeyframeFeeder\n"
                              "CPP UM octree OctreeBuilder --rebuild-period 20ms --voxel-size 0.05 "
                              "--laser-height 0.32\n")};
  auto has_octree = [&] { return are_nearly_expected(all<OctreeBlock>(system)); };
  system.wait_until("the octree of the corrected poses", has_octree);
  system.inject("crash octree");
  system.expect_back("octree");
  system.wait_until("the octree after the restart", has_octree);
  system.expect_nobody_else_down({"octree"});
}

TEST(MapExporter, WritesFilesWhenAskedAndAtTheEnd) {
  TemporaryFolder folder;
  {
    TestSystem system{cast_with("CPP UM feeder KeyframeFeeder\n"
                                "CPP UM grid GridBuilder\n"
                                "CPP UM octree OctreeBuilder\n"
                                "CPP UM exporter MapExporter --output " +
                                (folder / "end").string() +
                                "\n"
                                "CPP UM asker ExportAsker --folder " +
                                (folder / "asked").string() + "\n")};
    system.expect_entry("ExportedMap in mapping from asker");
    system.wait_until("the grid of the corrected poses",
                      [&] { return is_nearly(cell_map(all<GridTile>(system)), expected_map()); });
  }
  for (auto* name :
       {"map.yaml", "map.pgm", "map.png", "keyframes.g2o", "corrected.log", "map.ot", "map.bt"})
    EXPECT_TRUE(exists(folder / "end" / name)) << name;
  auto map = read_map_server(folder / "end" / "map.yaml");
  auto expected = expected_map();
  EXPECT_EQ(map.columns, expected.columns);
  EXPECT_NEAR(map.origin.x, expected.origin.x, 1e-9);
  EXPECT_GT(std::ranges::count(map.cells, 100), 100);
}

TEST(MapExporter, SaysWhatItLeavesOut) {
  TemporaryFolder folder;
  TestSystem system{cast_with("CPP UM exporter MapExporter\n"
                              "CPP UM asker ExportAsker --folder " +
                              (folder / "asked").string() + "\n")};
  system.expect_entry("ExportedMap in mapping from asker");
  for (auto& x : all<ExportedMap>(system)) {
    EXPECT_TRUE(x.files.empty());
    EXPECT_EQ(x.left_out.size(), 4U);
    EXPECT_EQ(x.left_out.back(), "map.ot: there is no octree");
  }
}

// -- poses and constraints

TEST(KeyframePoses, AreThoseOfTheGraphWhereItHasThem) {
  Keyframe x;
  x.number = 1;
  x.local_pose = {1, 0, 0};
  EXPECT_EQ(pose_in_map(x, nullptr), x.local_pose);
  GraphPoses graph;
  graph.poses = {{0, 0, 0}, {5, 6, 0.5}};
  graph.local_frame = {10, 0, 0};
  EXPECT_EQ(pose_in_map(x, &graph), (Pose2{5, 6, 0.5}));
  x.number = 2;
  EXPECT_EQ(pose_in_map(x, &graph), (Pose2{11, 0, 0}));
}

TEST(KeyframePoses, InformationIsTheInverseOfTheCovariance) {
  PoseCovariance c{0.04, 0.01, 0.002, 0.09, -0.003, 0.01};
  auto i = information_of(c);
  // Their product is the identity.
  EXPECT_NEAR(c.xx * i[0] + c.xy * i[1] + c.x_heading * i[2], 1, 1e-9);
  EXPECT_NEAR(c.xx * i[1] + c.xy * i[3] + c.x_heading * i[4], 0, 1e-9);
  EXPECT_NEAR(c.xx * i[2] + c.xy * i[4] + c.x_heading * i[5], 0, 1e-9);
  EXPECT_NEAR(c.xy * i[1] + c.yy * i[3] + c.y_heading * i[4], 1, 1e-9);
  EXPECT_NEAR(c.x_heading * i[2] + c.y_heading * i[4] + c.heading * i[5], 1, 1e-9);
  // Not positive definite.
  EXPECT_EQ(information_of({0.5, 1, 0, 0.5, 0, 0.25}), (std::array<double, 6>{2, 0, 0, 2, 0, 4}));
}

TEST(KeyframePoses, ContentsAreSortedAndComplete) {
  Keyframe a;
  a.number = 4;
  Keyframe b;
  b.number = 2;
  Constraint good;
  good.from = 2;
  good.to = 4;
  good.covariance = {1, 0, 0, 1, 0, 1};
  Constraint lost;
  lost.from = 2;
  lost.to = 3;
  auto x = contents_of({a, b}, {}, {good, lost});
  ASSERT_EQ(x.keyframes.size(), 2U);
  ASSERT_EQ(x.constraints.size(), 1U);
  EXPECT_EQ(x.constraints[0].from, 0U);
  EXPECT_EQ(x.constraints[0].to, 1U);
}

} // namespace

} // namespace castor::mapping::test
