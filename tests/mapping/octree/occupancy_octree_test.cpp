// The octree: evidence, queries, blocks, files.

#include "castor/mapping/geometry/poses.hpp"
#include "castor/mapping/grid/tile_codec.hpp"
#include "castor/mapping/logs/rawlog.hpp"
#include "castor/mapping/octree/anchored_octree.hpp"
#include "castor/mapping/octree/occupancy_octree.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

namespace castor::mapping::test {

namespace {

using geometry::Point3;

/// A wall at x = 2.025, 2 m wide and high, seen from 2 m before it.
PointCloud wall(const Point3& sensor = {0.025, 0.025, 0.025}) {
  PointCloud result{sensor, {}};
  for (double y = -1; y < 1; y += 0.02)
    for (double z = -1; z < 1; z += 0.02)
      result.points.push_back({2.025, y, z});
  return result;
}

OccupancyOctree octree_of_wall() {
  OccupancyOctree result;
  result.insert(wall());
  return result;
}

TEST(OccupancyOctree, KnowsWhatIsOccupiedFreeAndUnknown) {
  auto octree = octree_of_wall();
  EXPECT_EQ(octree.at({2.025, 0.5, 0.5}).occupancy, Occupancy::occupied);
  EXPECT_GT(octree.at({2.025, 0.5, 0.5}).probability, 0.6);
  EXPECT_EQ(octree.at({1, 0.1, 0.1}).occupancy, Occupancy::free);
  EXPECT_LT(octree.at({1, 0.1, 0.1}).probability, 0.5);
  EXPECT_EQ(octree.at({2.3, 0, 0}), (PointOccupancy{}));
  EXPECT_EQ(octree.at({-1, 0, 0}).occupancy, Occupancy::unknown);
  EXPECT_EQ(octree.at({1e9, 0, 0}).occupancy, Occupancy::unknown);
  EXPECT_EQ(octree.at({std::nan(""), 0, 0}).occupancy, Occupancy::unknown);
}

TEST(OccupancyOctree, FarPointsAreFreeSpaceUpToTheRange) {
  OccupancyOctree octree{{.voxel_size = 0.1, .max_range = 1}};
  octree.insert({{0.05, 0.05, 0.05}, {{5, 0.05, 0.05}}});
  EXPECT_EQ(octree.at({0.9, 0.05, 0.05}).occupancy, Occupancy::free);
  EXPECT_EQ(octree.at({1.3, 0.05, 0.05}).occupancy, Occupancy::unknown);
  EXPECT_EQ(octree.at({5, 0.05, 0.05}).occupancy, Occupancy::unknown);
}

TEST(OccupancyOctree, UnusablePointsAreIgnored) {
  OccupancyOctree octree;
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(octree.insert({{0, 0, 0}, {{nan, 0, 0}, {1e12, 0, 0}}}).empty());
  EXPECT_TRUE(octree.insert({{nan, 0, 0}, {{1, 0, 0}}}).empty());
  EXPECT_EQ(octree.leaves(), 0U);
  EXPECT_THROW(OccupancyOctree({.voxel_size = 0}), std::invalid_argument);
  EXPECT_THROW(OccupancyOctree({.max_range = -1}), std::invalid_argument);
}

TEST(OccupancyOctree, ARayEndsAtAWall) {
  auto octree = octree_of_wall();
  auto end = octree.cast({.origin = {0.025, 0.025, 0.025}, .direction = {3, 0, 0}, .max_range = 5});
  EXPECT_EQ(end.met, Occupancy::occupied);
  EXPECT_NEAR(end.point.x, 2.025, 1e-3);
  EXPECT_NEAR(end.distance, 2, 1e-3);
}

TEST(OccupancyOctree, ARayEndsAtItsRangeOrInUnknownSpace) {
  auto octree = octree_of_wall();
  auto end = octree.cast({.origin = {0.025, 0.025, 0.025}, .direction = {1, 0, 0}, .max_range = 1});
  EXPECT_EQ(end.met, Occupancy::free);
  EXPECT_NEAR(end.point.x, 1.025, 1e-6);
  AskRay back{.origin = {0.025, 0.025, 0.025}, .direction = {-1, 0, 0}, .max_range = 3};
  EXPECT_EQ(octree.cast(back).met, Occupancy::free);
  EXPECT_EQ(octree.cast(back).distance, 3);
  back.stops_at_unknown = true;
  EXPECT_EQ(octree.cast(back).met, Occupancy::unknown);
  EXPECT_LT(octree.cast(back).distance, 0.2);
  back.direction = {};
  EXPECT_THROW(octree.cast(back), std::invalid_argument);
}

TEST(OccupancyOctree, ABoxIsFreeIfAllOfItIs) {
  auto octree = octree_of_wall();
  auto free = octree.look_into({{1, 0.1, 0.1}, {0.2, 0.1, 0.1}, {}});
  EXPECT_EQ(free.occupancy, Occupancy::free);
  EXPECT_GE(free.voxels, 4 * 2 * 2);
  auto occupied = octree.look_into({{1.9, 0.1, 0.1}, {0.3, 0.1, 0.1}, {}});
  EXPECT_EQ(occupied.occupancy, Occupancy::occupied);
  EXPECT_GT(occupied.occupied_voxels, 0);
  auto unknown = octree.look_into({{0, 0.1, 0.1}, {0.3, 0.1, 0.1}, {}});
  EXPECT_EQ(unknown.occupancy, Occupancy::unknown);
  EXPECT_THROW(octree.look_into({{0, 0, 0}, {-1, 1, 1}, {}}), std::invalid_argument);
  EXPECT_THROW(octree.look_into({{0, 0, 0}, {100, 100, 100}, {}}), std::invalid_argument);
  EXPECT_THROW(octree.look_into({{1e9, 0, 0}, {1, 1, 1}, {}}), std::invalid_argument);
}

TEST(OccupancyOctree, ACopyThatIsToldOfChangedBlocksIsTheSame) {
  OccupancyOctree octree;
  OccupancyOctree copy;
  for (int i = 0; i < 4; ++i) {
    auto changed = octree.insert(wall({0.025, 0.1 * i, 0.025}));
    EXPECT_FALSE(changed.empty());
    std::map<BlockIndex, BlockVoxels> blocks;
    for (auto& x : changed)
      blocks[x] = decode_tile(encode_tile(octree.block(x)));
    copy.set_blocks(blocks);
  }
  EXPECT_EQ(copy.blocks(), octree.blocks());
  for (auto& x : octree.blocks())
    EXPECT_EQ(copy.block(x), octree.block(x));
  for (double x = -0.5; x < 2.5; x += 0.05)
    for (double y = -1; y < 1; y += 0.05)
      ASSERT_EQ(copy.at({x, y, 0.1}).occupancy, octree.at({x, y, 0.1}).occupancy) << x << ' ' << y;
}

TEST(OccupancyOctree, WhatHasReachedItsLimitsIsNoChange) {
  OccupancyOctree octree;
  for (int i = 0; i < 20; ++i)
    octree.insert(wall());
  EXPECT_TRUE(octree.insert(wall()).empty());
}

TEST(OccupancyOctree, BlocksOfNegativeCoordinates) {
  OccupancyOctree octree{{.voxel_size = 0.1, .max_range = 5}};
  auto changed = octree.insert({{-0.05, -0.05, -0.05}, {{-0.15, -0.05, -0.05}}});
  EXPECT_EQ(changed, (std::set<BlockIndex>{{-1, -1, -1}}));
  auto voxels = octree.block({-1, -1, -1});
  // The last voxel of all is the one of the sensor, and the one before has the point.
  EXPECT_LT(voxels.back(), 0);
  EXPECT_GT(voxels[voxels.size() - 2], 0);
  OccupancyOctree copy{{.voxel_size = 0.1, .max_range = 5}};
  copy.set_blocks({{{-1, -1, -1}, voxels}});
  voxels[voxels.size() - 2] = unknown_cell;
  copy.set_blocks({{{-1, -1, -1}, voxels}});
  EXPECT_EQ(copy.at({-0.15, -0.05, -0.05}).occupancy, Occupancy::unknown);
}

TEST(OccupancyOctree, WritesBothFilesOfOctoMap) {
  castor::test::TemporaryFolder folder;
  auto octree = octree_of_wall();
  auto before = octree.at({2.025, 0.5, 0.5});
  for (auto [name, magic] : {std::pair{"map.ot", "# Octomap OcTree file"},
                             std::pair{"map.bt", "# Octomap OcTree binary file"}}) {
    octree.write(folder / name);
    std::string line;
    std::ifstream file{folder / name};
    std::getline(file, line);
    EXPECT_EQ(line, magic);
  }
  EXPECT_EQ(octree.at({2.025, 0.5, 0.5}), before);
  EXPECT_LT(file_size(folder / "map.bt"), file_size(folder / "map.ot"));
  EXPECT_THROW(octree.write(folder / "map.obj"), std::runtime_error);
  EXPECT_THROW(octree.write(folder / "none" / "map.ot"), std::runtime_error);
}

TEST(OccupancyOctree, TimeForALargeCloud) {
  OccupancyOctree octree;
  PointCloud cloud{{0, 0, 1}, {}};
  // 64 rings of 1800 points in a room of 10 x 8 x 3 m.
  for (int ring = 0; ring < 64; ++ring)
    for (int i = 0; i < 1800; ++i) {
      auto elevation = (-24 + 0.75 * ring) * std::numbers::pi / 180;
      auto angle = 2 * std::numbers::pi * i / 1800;
      Point3 d{std::cos(elevation) * std::cos(angle), std::cos(elevation) * std::sin(angle),
               std::sin(elevation)};
      auto range = std::min({5 / std::abs(d.x), 4 / std::abs(d.y), d.z > 0 ? 2 / d.z : -1 / d.z});
      cloud.points.push_back({range * d.x, range * d.y, 1 + range * d.z});
    }
  auto start = std::chrono::steady_clock::now();
  auto changed = octree.insert(cloud);
  auto milliseconds =
    std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  std::size_t bytes = 0;
  for (auto& x : changed)
    bytes += encode_tile(octree.block(x)).size();
  std::cout << cloud.points.size() << " points at 5 cm: " << milliseconds << " ms, "
            << changed.size() << " blocks of together " << bytes << " bytes\n";
  EXPECT_GT(octree.leaves(), 10000U);
}

/// A depth camera and a Velodyne, of Debian's package mrpt-common.
TEST(OccupancyOctree, TakesTheCloudsOfMrptsRawlogs) {
  for (auto* name : {"tests_rgbd.rawlog", "test_velodyne_VLP16.rawlog"}) {
    auto file = std::filesystem::path{"/usr/share/mrpt/datasets"} / name;
    if (!exists(file))
      GTEST_SKIP() << "needs the package mrpt-common";
    auto read = read_rawlog(file);
    ASSERT_TRUE(read.rawlog) << render(read.diagnostics);
    ASSERT_EQ(read.rawlog->clouds.size(), 1U);
    auto& cloud = read.rawlog->clouds[0];
    OccupancyOctree octree{{.voxel_size = 0.05, .max_range = 8}};
    auto start = std::chrono::steady_clock::now();
    auto changed = octree.insert({cloud.sensor, cloud.points});
    auto milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    std::size_t bytes = 0;
    for (auto& x : changed)
      bytes += encode_tile(octree.block(x)).size();
    std::cout << name << ": " << cloud.points.size() << " points at 5 cm: " << milliseconds
              << " ms, " << octree.leaves() << " leaves, " << changed.size()
              << " blocks of together " << bytes << " bytes\n";
    // What is nearer than the range is occupied where it was seen.
    std::size_t near = 0;
    std::size_t occupied = 0;
    for (std::size_t i = 0; i < cloud.points.size(); i += 97)
      if (geometry::distance(cloud.points[i], cloud.sensor) < 7.9) {
        ++near;
        occupied += octree.at(cloud.points[i]).occupancy == Occupancy::occupied;
      }
    EXPECT_GT(near, 30U) << name;
    EXPECT_EQ(occupied, near) << name;
  }
}

// -- clouds of a robot whose poses are corrected

TEST(AnchoredOctree, AfterARebuildItIsTheOctreeOfTheCorrectedPoses) {
  AnchoredOctree anchored;
  auto cloud = std::make_shared<PointCloud>(wall());
  EXPECT_FALSE(anchored.place("a", cloud, {}).empty());
  EXPECT_FALSE(anchored.place("b", cloud, {0, 0, 1}).empty());
  EXPECT_TRUE(anchored.place("b", nullptr, {0.01, 0, 1}).empty());
  EXPECT_FALSE(anchored.is_outdated());
  const Pose2 corrected{1, 0.5, 1.5};
  EXPECT_TRUE(anchored.place("b", nullptr, corrected).empty());
  EXPECT_TRUE(anchored.is_outdated());
  OccupancyOctree copy;
  auto tell = [&](const std::set<BlockIndex>& indices) {
    std::map<BlockIndex, BlockVoxels> blocks;
    for (auto& x : indices)
      blocks[x] = anchored.octree().block(x);
    copy.set_blocks(blocks);
  };
  tell(anchored.octree().blocks());
  auto changed = anchored.rebuild();
  EXPECT_FALSE(anchored.is_outdated());
  OccupancyOctree expected;
  expected.insert(wall());
  expected.insert(transform(corrected, *cloud));
  EXPECT_EQ(anchored.octree().blocks(), expected.blocks());
  for (auto& x : expected.blocks())
    EXPECT_EQ(anchored.octree().block(x), expected.block(x));
  // Who is told of the changed blocks has the same.
  tell(changed);
  EXPECT_EQ(copy.blocks(), expected.blocks());
}

TEST(AnchoredOctree, WhatHappensDuringARebuildIsNotForgotten) {
  AnchoredOctree anchored;
  auto cloud = std::make_shared<PointCloud>(wall());
  for (auto* name : {"a", "b", "c"})
    anchored.place(name, cloud, {});
  anchored.place("c", nullptr, {1, 0, 0});
  EXPECT_TRUE(anchored.rebuild(2).empty());
  EXPECT_TRUE(anchored.is_rebuilding());
  // The old octree answers meanwhile, and has the new cloud.
  EXPECT_FALSE(anchored.place("d", cloud, {0, 5, 0}).empty());
  EXPECT_EQ(anchored.octree().at({2.025, 5.5, 0.5}).occupancy, Occupancy::occupied);
  // Whether they are in the new octree yet or not.
  for (auto* name : {"a", "b"})
    anchored.place(name, nullptr, {3, 0, 0});
  anchored.remove("c");
  std::set<BlockIndex> changed;
  while (anchored.is_rebuilding())
    changed = anchored.rebuild(1);
  EXPECT_FALSE(changed.empty());
  EXPECT_EQ(anchored.octree().at({2.025, 5.5, 0.5}).occupancy, Occupancy::occupied);
  EXPECT_TRUE(anchored.is_outdated());
  anchored.rebuild();
  EXPECT_FALSE(anchored.is_outdated());
  OccupancyOctree expected;
  expected.insert(transform({3, 0, 0}, *cloud));
  expected.insert(transform({3, 0, 0}, *cloud));
  expected.insert(transform({0, 5, 0}, *cloud));
  EXPECT_EQ(anchored.octree().blocks(), expected.blocks());
  for (auto& x : expected.blocks())
    EXPECT_EQ(anchored.octree().block(x), expected.block(x));
}

TEST(AnchoredOctree, ARemovedCloudIsGoneAfterARebuild) {
  AnchoredOctree anchored;
  anchored.place("a", std::make_shared<PointCloud>(wall()), {});
  anchored.remove("nobody");
  EXPECT_FALSE(anchored.is_outdated());
  anchored.remove("a");
  EXPECT_TRUE(anchored.is_outdated());
  EXPECT_FALSE(anchored.rebuild().empty());
  EXPECT_EQ(anchored.octree().leaves(), 0U);
}

TEST(AnchoredOctree, RestoredBlocksAnswerUntilTheRebuildIsComplete) {
  auto cloud = std::make_shared<PointCloud>(wall());
  AnchoredOctree before;
  before.place("a", cloud, {});
  std::map<BlockIndex, BlockVoxels> blocks;
  for (auto& x : before.octree().blocks())
    blocks[x] = before.octree().block(x);
  AnchoredOctree anchored;
  anchored.restore(blocks);
  anchored.anchor("a", cloud, {0, 5, 0});
  EXPECT_TRUE(anchored.is_outdated());
  for (auto& x : before.octree().blocks())
    EXPECT_EQ(anchored.octree().block(x), before.octree().block(x));
  anchored.place("b", cloud, {0, -5, 0});
  EXPECT_TRUE(anchored.rebuild(1).empty());
  EXPECT_EQ(anchored.octree().at({2.025, 0.5, 0.5}).occupancy, Occupancy::occupied);
  const auto changed = anchored.rebuild();
  OccupancyOctree expected;
  expected.insert(transform({0, 5, 0}, *cloud));
  expected.insert(transform({0, -5, 0}, *cloud));
  EXPECT_EQ(anchored.octree().blocks(), expected.blocks());
  for (auto& [index, voxels] : blocks)
    EXPECT_TRUE(changed.contains(index));
  for (auto& x : expected.blocks()) {
    EXPECT_TRUE(changed.contains(x));
    EXPECT_EQ(anchored.octree().block(x), expected.block(x));
  }
}

// -- clouds

TEST(PointCloud, OfALaserScan) {
  LaserScan scan;
  scan.mount = {0.2, 0, 0};
  scan.first_angle = 0;
  scan.angle_step = std::numbers::pi / 2;
  scan.ranges = {1, 0, std::numeric_limits<float>::infinity()};
  auto cloud = cloud_of(scan, {1, 2, std::numbers::pi / 2}, 0.3);
  EXPECT_NEAR(cloud.sensor.y, 2.2, 1e-9);
  EXPECT_EQ(cloud.sensor.z, 0.3);
  ASSERT_EQ(cloud.points.size(), 1U);
  EXPECT_NEAR(cloud.points[0].x, 1, 1e-9);
  EXPECT_NEAR(cloud.points[0].y, 3.2, 1e-9);
}

TEST(PointCloud, OfADepthImage) {
  geometry::Camera camera;
  camera.width = 3;
  camera.height = 2;
  camera.fx = camera.fy = 1;
  camera.cx = 1;
  camera.cy = 0;
  camera.pose.position = {0, 0, 5};
  const std::vector<float> depths{2, 3, 0, 4, std::numeric_limits<float>::quiet_NaN(), 1};
  auto cloud = cloud_of(depths, camera);
  ASSERT_EQ(cloud.points.size(), 4U);
  EXPECT_NEAR(geometry::Point3(cloud.points[0]).x, -2, 1e-9);
  EXPECT_NEAR(cloud.points[0].z, 7, 1e-9);
  EXPECT_NEAR(cloud.points[1].z, 8, 1e-9);
  EXPECT_NEAR(cloud.points[2].x, -4, 1e-9);
  EXPECT_NEAR(cloud.points[2].y, 4, 1e-9);
  EXPECT_NEAR(cloud.points[3].z, 6, 1e-9);
  EXPECT_EQ(cloud_of(depths, camera, 2).points.size(), 1U);
  EXPECT_THROW(cloud_of(depths, camera, 0), std::invalid_argument);
  camera.width = 4;
  EXPECT_THROW(cloud_of(depths, camera), std::invalid_argument);
}

} // namespace

} // namespace castor::mapping::test
