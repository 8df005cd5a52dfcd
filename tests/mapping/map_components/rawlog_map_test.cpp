// MRPT's recorded robots, from the log to the files of the map.

#include "castor/mapping/exports/map_picture.hpp"
#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/grid/keyframe_grid.hpp"
#include "castor/mapping/grid/tile_entries.hpp"
#include "castor/mapping/logs/robot_log_file.hpp"
#include "castor/mapping/map_components/keyframe_poses.hpp"
#include "castor/mapping/map_components/map_files.hpp"
#include "castor/mapping/slam/slam.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping::test {

namespace {

const std::filesystem::path datasets = "/usr/share/mrpt/datasets";

struct Mapped {
  std::size_t scans = 0;
  double seconds = 0;
  std::vector<TimedPose> path;
  std::vector<Pose2> odometry;
  ExportedMap files;
};

/// Maps a log, and writes all files. CASTOR_MAPS_OUTPUT names a folder to keep them in.
std::optional<Mapped> map_of(const std::filesystem::path& file) {
  auto read = read_robot_log(file);
  if (!read.log) {
    ADD_FAILURE() << render(read.diagnostics);
    return std::nullopt;
  }
  Mapped result;
  result.scans = read.log->scans.size();
  Slam slam;
  std::vector<Keyframe> keyframes;
  auto start = std::chrono::steady_clock::now();
  for (auto& x : read.log->scans) {
    result.odometry.push_back(x.odometry.pose);
    auto step = slam.add(x.scan, x.odometry.pose);
    if (step.new_keyframe)
      keyframes.push_back(*step.new_keyframe);
  }
  slam.finish();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.path = slam.path();
  // The pose of a keyframe is that of its scan.
  GraphPoses graph;
  for (auto& x : keyframes) {
    auto pose = std::ranges::lower_bound(result.path, x.time, {}, &TimedPose::time);
    graph.poses.push_back(pose->pose);
  }
  KeyframeGrid grid;
  TileEntries entries;
  for (auto& x : keyframes)
    grid.place(std::to_string(x.number), std::make_shared<LaserScan>(x.scan),
               pose_in_map(x, &graph));
  auto indices = grid.grid().tiles();
  auto tiles = entries.changed(grid.grid(), {indices.begin(), indices.end()});
  castor::test::TemporaryFolder temporary;
  auto* kept = std::getenv("CASTOR_MAPS_OUTPUT");
  auto folder = kept ? std::filesystem::path{kept} / file.stem() : temporary.path();
  result.files = write_map_files(folder, contents_of(keyframes, graph, {}), tiles, {});
  std::cout << file.filename().string() << ": " << result.scans << " scans, " << keyframes.size()
            << " keyframes, " << 1000 * result.seconds / static_cast<double>(result.scans)
            << " ms for a scan, " << tiles.size() << " tiles, " << slam.dead_reckoned()
            << " scans did not fit\n";
  return result;
}

/// Root mean square and largest distance of paths that both begin at the origin, metres.
std::pair<double, double> errors(const std::vector<Pose2>& path, const std::vector<Pose2>& truth) {
  double sum = 0;
  double largest = 0;
  auto count = std::min(path.size(), truth.size());
  for (std::size_t i = 0; i < count; ++i) {
    auto x = distance(path[i], truth[i]);
    sum += x * x;
    largest = std::max(largest, x);
  }
  return {std::sqrt(sum / static_cast<double>(count)), largest};
}

/// Lines of time, x, y and heading.
std::vector<Pose2> truth_of(const std::filesystem::path& file) {
  std::ifstream in{file};
  std::vector<Pose2> result;
  double time = 0;
  for (Pose2 x; in >> time >> x.x >> x.y >> x.heading;)
    result.push_back(x);
  return result;
}

/// A log of which the true path is known. Files are named from the folder of MRPT's datasets.
struct KnownPath {
  const char* log;
  const char* truth;
  /// Error of the path, as a share of that of odometry.
  double most_error;
};

class RawlogWithTruth : public testing::TestWithParam<KnownPath> {};

TEST_P(RawlogWithTruth, IsMappedCloserToTheTruthThanByOdometry) {
  auto file = datasets / GetParam().log;
  if (!exists(file))
    GTEST_SKIP() << "needs the package mrpt-common";
  auto mapped = map_of(file);
  ASSERT_TRUE(mapped);
  auto truth = truth_of(datasets / GetParam().truth);
  // Some have a line before the first scan, some none for the last.
  ASSERT_LE(std::max(truth.size(), mapped->scans) - std::min(truth.size(), mapped->scans), 1U);
  if (truth.size() > mapped->scans)
    truth.erase(truth.begin());
  std::vector<Pose2> path;
  for (auto& x : mapped->path)
    path.push_back(x.pose);
  ASSERT_EQ(path.size(), mapped->scans);
  // All in the frame of the first scan.
  auto from_first = [](std::vector<Pose2>& poses) {
    auto first = poses.front();
    for (auto& x : poses)
      x = between(first, x);
  };
  from_first(path);
  from_first(truth);
  from_first(mapped->odometry);
  auto [rms, largest] = errors(path, truth);
  auto [odometry_rms, odometry_largest] = errors(mapped->odometry, truth);
  std::cout << "  error " << rms << " m rms, " << largest << " m at most; odometry " << odometry_rms
            << " and " << odometry_largest << " m\n";
  EXPECT_LT(rms, GetParam().most_error * odometry_rms);
}

INSTANTIATE_TEST_SUITE_P(
  Mrpt, RawlogWithTruth,
  testing::Values(KnownPath{"graphslam-engine-demos/action_observations_map/simul.rawlog",
                            "graphslam-engine-demos/action_observations_map/"
                            "simul.rawlog.GT.txt",
                            0.1},
                  // Its ranges have a standard deviation of 0.3 m.
                  KnownPath{"graphslam-engine-demos/action_observations_map/"
                            "range_030_bearing_015.rawlog",
                            "graphslam-engine-demos/action_observations_map/"
                            "range_030_bearing_015.rawlog.GT.txt",
                            1},
                  KnownPath{"uwb_ro-localization_demo.rawlog", "uwb_ro-localization_demo_GT.txt",
                            1}));

TEST(RecordedRawlog, IsMapped) {
  auto files = {"2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog",
                "localization_demo.rawlog"};
  for (auto* name : files) {
    if (!exists(datasets / name))
      GTEST_SKIP() << "needs the package mrpt-common";
    auto mapped = map_of(datasets / name);
    ASSERT_TRUE(mapped) << name;
    // All but the octree.
    EXPECT_EQ(mapped->files.files.size(), 5U) << name;
  }
}

} // namespace

} // namespace castor::mapping::test
