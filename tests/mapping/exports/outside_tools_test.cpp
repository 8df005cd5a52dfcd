// Exported maps, opened by tools of others: MRPT's (Debian's package mrpt-apps) and OctoMap's
// (octomap-tools). Each test skips where the tool is not installed.

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/octree/occupancy_octree.hpp"
#include "castor/tests/support/process.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace castor::mapping::test {

namespace {

using castor::test::Process;
using castor::test::TemporaryFolder;
using testing::HasSubstr;

const std::filesystem::path mrpt_data = "/usr/share/mrpt";

std::string tool(const std::string& name) {
  auto path = "/usr/bin/" + name;
  return std::filesystem::exists(path) ? path : std::string{};
}

/// Output and errors of a command that has to succeed.
std::string run(const std::vector<std::string>& command) {
  Process process{command};
  EXPECT_EQ(process.wait(), 0) << command[0] << ": " << process.output() << process.errors();
  return process.output() + process.errors();
}

LaserScan laser_scan(const mrpt::obs::CObservation2DRangeScan& x) {
  LaserScan result;
  result.mount = {x.sensorPose.x(), x.sensorPose.y(), x.sensorPose.yaw()};
  result.first_angle = -static_cast<double>(x.aperture) / 2;
  result.angle_step = static_cast<double>(x.aperture) / static_cast<double>(x.getScanSize() - 1);
  result.max_range = static_cast<double>(x.maxRange);
  for (std::size_t i = 0; i < x.getScanSize(); ++i) {
    auto at = x.rightToLeft ? i : x.getScanSize() - 1 - i;
    result.ranges.push_back(x.getScanRangeValidity(at) ? x.getScanRange(at) : 0);
  }
  return result;
}

/// Our grid of the keyframes that MRPT's demonstration of localisation has.
CellMap demo_map() {
  mrpt::maps::CSimpleMap keyframes;
  mrpt::io::CFileGZInputStream file{
    (mrpt_data / "datasets/localization_demo.simplemap.gz").string()};
  mrpt::serialization::archiveFrom(file) >> keyframes;
  OccupancyGrid grid;
  for (auto& x : keyframes) {
    mrpt::poses::CPose3D pose;
    x.pose->getMean(pose);
    for (auto& observation : *x.sf)
      if (auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation))
        grid.insert(laser_scan(*scan), {pose.x(), pose.y(), pose.yaw()});
  }
  return cell_map(grid);
}

TEST(OutsideTools, RosMapYaml2mrptReadsTheMap) {
  auto converter = tool("ros-map-yaml2mrpt");
  if (converter.empty())
    GTEST_SKIP() << "needs the package mrpt-apps";
  TemporaryFolder folder;
  CellMap map{60, 40, 0.05, {-1, -0.5, 0}, std::vector<std::int8_t>(2400, 0)};
  for (int i = 0; i < 40; ++i)
    map.at(10, i) = 100;
  map.at(59, 39) = -1;
  write_map_server(map, folder / "map");
  auto printed = run({converter, "-i", (folder / "map.yaml").string(), "-w"});
  EXPECT_THAT(printed, HasSubstr("All done."));
  mrpt::maps::COccupancyGridMap2D theirs;
  mrpt::io::CFileGZInputStream file{(folder / "map.gridmap.gz").string()};
  mrpt::serialization::archiveFrom(file) >> theirs;
  EXPECT_EQ(theirs.getSizeX(), 60U);
  EXPECT_EQ(theirs.getSizeY(), 40U);
  EXPECT_NEAR(theirs.getXMin(), -1, 1e-5);
  EXPECT_NEAR(theirs.getYMin(), -0.5, 1e-5);
  for (int column = 0; column < map.columns; ++column)
    for (int row = 0; row < map.rows; ++row) {
      auto free = theirs.getCell(column, row);
      auto expected = map.at(column, row);
      EXPECT_TRUE(expected == 100 ? free < 0.3F
                  : expected == 0 ? free > 0.7F
                                  : free > 0.3F && free < 0.7F)
        << column << ' ' << row << ": " << free;
    }
}

TEST(OutsideTools, PfLocalizationFindsTheRobotInTheMap) {
  auto converter = tool("ros-map-yaml2mrpt");
  auto localization = tool("pf-localization");
  if (converter.empty() || localization.empty() || !exists(mrpt_data / "datasets"))
    GTEST_SKIP() << "needs the packages mrpt-apps and mrpt-common";
  TemporaryFolder folder;
  write_map_server(demo_map(), folder / "map");
  run({converter, "-i", (folder / "map.yaml").string(), "-w"});
  std::ifstream in{mrpt_data / "config_files/pf-localization/localization_demo.ini"};
  std::string settings{std::istreambuf_iterator<char>{in}, {}};
  auto set = [&](const std::string& key, const std::string& value) {
    auto before = settings;
    settings = std::regex_replace(settings, std::regex{"(^|\n)" + key + "[ ]*=[^\n]*"},
                                  "$1" + key + "=" + value);
    EXPECT_NE(settings, before) << key;
  };
  set("map_file", (folder / "map.gridmap.gz").string());
  set("rawlog_file", (mrpt_data / "datasets/localization_demo.rawlog").string());
  set("logOutput_dir", (folder / "log").string());
  set("3DSceneFrequency", "1000");
  set("SHOW_PROGRESS_3D_REAL_TIME", "false");
  std::ofstream(folder / "settings.ini") << settings;
  auto printed = run({localization, (folder / "settings.ini").string()});
  std::smatch last;
  std::regex estimate{R"(PDF estimation: \(([-0-9.]+),([-0-9.]+),([-0-9.]+)deg\))"};
  int estimates = 0;
  for (std::sregex_iterator x{printed.begin(), printed.end(), estimate}, end; x != end; ++x) {
    last = *x;
    ++estimates;
  }
  ASSERT_GT(estimates, 30) << printed.substr(0, 2000);
  std::cout << estimates << " estimates, the last " << last[0] << '\n';
  // Where MRPT finds the robot with its own map.
  EXPECT_NEAR(std::stod(last[1]), 15.92, 0.3);
  EXPECT_NEAR(std::stod(last[2]), -10.00, 0.3);
  EXPECT_NEAR(std::stod(last[3]), 4.9, 5);
}

TEST(OutsideTools, OctomapToolsReadTheOctree) {
  auto converter = tool("convert_octree");
  auto comparer = tool("compare_octrees");
  if (converter.empty() || comparer.empty())
    GTEST_SKIP() << "needs the package octomap-tools";
  OccupancyOctree octree;
  PointCloud cloud{{0, 0, 0.5}, {}};
  for (double y = -1; y < 1; y += 0.02)
    for (double z = 0; z < 1; z += 0.02)
      cloud.points.push_back({2, y, z});
  octree.insert(cloud);
  TemporaryFolder folder;
  octree.write(folder / "map.ot");
  octree.write(folder / "map.bt");
  auto printed = run({converter, (folder / "map.bt").string(), (folder / "from_bt.ot").string()});
  std::cout << printed;
  EXPECT_TRUE(exists(folder / "from_bt.ot"));
  run({converter, (folder / "map.ot").string(), (folder / "from_ot.bt").string()});
  EXPECT_TRUE(exists(folder / "from_ot.bt"));
  // The same tree twice differs by nothing.
  printed = run({comparer, (folder / "map.ot").string(), (folder / "map.ot").string()});
  std::cout << printed;
  // The divergence of Kullback and Leibler.
  EXPECT_THAT(printed, HasSubstr("KLD: 0\n"));
  // With more evidence, the same voxels have other probabilities.
  octree.insert(cloud);
  octree.write(folder / "other.ot");
  printed = run({comparer, (folder / "map.ot").string(), (folder / "other.ot").string()});
  EXPECT_THAT(printed, testing::Not(HasSubstr("KLD: 0\n")));
}

} // namespace

} // namespace castor::mapping::test
