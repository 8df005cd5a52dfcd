// Rawlogs of MRPT.

#include "castor/mapping/logs/rawlog.hpp"
#include "castor/mapping/logs/robot_log_file.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <numbers>
#include <string>

namespace castor::mapping::test {

namespace {

using castor::test::TemporaryFolder;
using mrpt::obs::CObservation2DRangeScan;
using std::numbers::pi;
using testing::HasSubstr;

mrpt::Clock::time_point seconds(double x) {
  return mrpt::Clock::fromDouble(1e9 + x);
}

/// Three beams: right, ahead, left.
CObservation2DRangeScan scan_at(double time, const std::string& label = "LASER") {
  CObservation2DRangeScan result;
  result.timestamp = seconds(time);
  result.sensorLabel = label;
  result.aperture = static_cast<float>(pi);
  result.rightToLeft = true;
  result.maxRange = 10;
  result.resizeScan(3);
  for (std::size_t i = 0; i < 3; ++i) {
    result.setScanRange(i, static_cast<float>(i + 1));
    result.setScanRangeValidity(i, true);
  }
  return result;
}

template <class... Objects>
std::filesystem::path write(const TemporaryFolder& folder, const Objects&... objects) {
  auto path = folder / "a.rawlog";
  mrpt::io::CFileGZOutputStream file{path.string()};
  auto archive = mrpt::serialization::archiveFrom(file);
  (archive.WriteObject(&objects), ...);
  return path;
}

std::string problems(const RawlogResult& result) {
  return render(result.diagnostics);
}

TEST(RawlogReader, AddsUpTheIncrementsOfOdometry) {
  TemporaryFolder folder;
  mrpt::obs::CActionRobotMovement2D movement;
  movement.computeFromOdometry({1, 0, pi / 2}, {});
  mrpt::obs::CActionCollection actions{movement};
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<CObservation2DRangeScan>(scan_at(1)));
  mrpt::obs::CSensoryFrame later;
  later.insert(std::make_shared<CObservation2DRangeScan>(scan_at(2)));
  auto result = read_rawlog(write(folder, actions, frame, actions, later));
  ASSERT_TRUE(result.rawlog) << problems(result);
  auto& scans = result.rawlog->log.scans;
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_NEAR(scans[0].odometry.pose.x, 1, 1e-9);
  EXPECT_NEAR(scans[1].odometry.pose.x, 1, 1e-9);
  EXPECT_NEAR(scans[1].odometry.pose.y, 1, 1e-9);
  EXPECT_NEAR(scans[1].odometry.pose.heading, pi, 1e-9);
  EXPECT_EQ(scans[1].scan.time - scans[0].scan.time, 1'000'000);
  EXPECT_EQ(result.rawlog->contents.at("CObservation2DRangeScan LASER"), 2U);
  EXPECT_EQ(result.rawlog->contents.at("CActionRobotMovement2D"), 2U);
}

TEST(RawlogReader, TakesAbsoluteOdometryAndTheMount) {
  TemporaryFolder folder;
  mrpt::obs::CObservationOdometry odometry;
  odometry.timestamp = seconds(0.5);
  odometry.odometry = {3, 4, 0.5};
  odometry.hasVelocities = true;
  odometry.velocityLocal = {0.25, 0, 0.125};
  auto scan = scan_at(1);
  scan.sensorPose = mrpt::poses::CPose3D(0.2, -0.1, 0.5, 0.3, 0, 0);
  scan.setScanRangeValidity(1, false);
  scan.setScanRange(2, 10);
  auto result = read_rawlog(write(folder, odometry, scan));
  ASSERT_TRUE(result.rawlog) << problems(result);
  ASSERT_EQ(result.rawlog->log.odometry.size(), 1U);
  EXPECT_EQ(result.rawlog->log.odometry[0].velocity, (Twist2{0.25, 0.125}));
  auto& x = result.rawlog->log.scans.at(0);
  EXPECT_EQ(x.odometry.pose, (Pose2{3, 4, 0.5}));
  EXPECT_NEAR(x.scan.mount.y, -0.1, 1e-9);
  EXPECT_NEAR(x.scan.mount.heading, 0.3, 1e-9);
  EXPECT_NEAR(x.scan.first_angle, -pi / 2, 1e-6);
  EXPECT_NEAR(x.scan.angle_step, pi / 2, 1e-6);
  // Invalid, and at its maximal range: nothing came back.
  EXPECT_EQ(x.scan.ranges, (std::vector<float>{1, 0, 0}));
}

TEST(RawlogReader, TurnsScansOver) {
  TemporaryFolder folder;
  auto scan = scan_at(1);
  scan.rightToLeft = false;
  EXPECT_EQ(read_rawlog(write(folder, scan)).rawlog->log.scans.at(0).scan.ranges,
            (std::vector<float>{3, 2, 1}));
  scan.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0, pi);
  EXPECT_EQ(read_rawlog(write(folder, scan)).rawlog->log.scans.at(0).scan.ranges,
            (std::vector<float>{1, 2, 3}));
}

TEST(RawlogReader, ChoosesALaser) {
  TemporaryFolder folder;
  auto path = write(folder, scan_at(1, "A"), scan_at(2, "B"), scan_at(3, "B"));
  auto result = read_rawlog(path);
  ASSERT_TRUE(result.rawlog);
  EXPECT_EQ(result.rawlog->log.scans.size(), 2U);
  EXPECT_THAT(problems(result), HasSubstr("'A' (1), 'B' (2); the scans are those of 'B'"));
  EXPECT_EQ(read_rawlog(path, {.laser = "A"}).rawlog->log.scans.size(), 1U);
  result = read_rawlog(path, {.laser = "C"});
  EXPECT_FALSE(result.rawlog);
  EXPECT_THAT(problems(result), HasSubstr("no scans of the sensor 'C'"));
}

TEST(RawlogReader, SortsAndWarnsIfTimeRunsBackward) {
  TemporaryFolder folder;
  auto unknown = scan_at(0);
  unknown.timestamp = INVALID_TIMESTAMP;
  auto result = read_rawlog(write(folder, scan_at(2), scan_at(1), unknown));
  ASSERT_TRUE(result.rawlog);
  EXPECT_THAT(problems(result), HasSubstr("time runs backward at 1 of the observations"));
  EXPECT_THAT(problems(result), HasSubstr("1 observations have no time stamp"));
  auto& scans = result.rawlog->log.scans;
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[1].scan.time - scans[0].scan.time, 100'000);
  EXPECT_EQ(scans[2].scan.time - scans[0].scan.time, 1'000'000);
}

TEST(RawlogReader, ScansBeforeTheFirstTimeStampAreJustBeforeIt) {
  TemporaryFolder folder;
  auto unknown = scan_at(0);
  unknown.timestamp = INVALID_TIMESTAMP;
  auto result = read_rawlog(write(folder, unknown, unknown, scan_at(3)));
  ASSERT_TRUE(result.rawlog);
  auto& scans = result.rawlog->log.scans;
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[1].scan.time - scans[0].scan.time, 100'000);
  EXPECT_EQ(scans[2].scan.time - scans[1].scan.time, 100'000);
  for (auto& x : scans) {
    EXPECT_EQ(x.odometry.time, x.scan.time);
    EXPECT_EQ(x.logged_time, x.scan.time);
  }
}

TEST(RawlogReader, ALogWithoutLaserSaysWhatItHas) {
  TemporaryFolder folder;
  mrpt::obs::CObservationBeaconRanges beacons;
  beacons.sensorLabel = "RADIO";
  auto result = read_rawlog(write(folder, beacons, beacons));
  EXPECT_FALSE(result.rawlog);
  EXPECT_THAT(problems(result), HasSubstr("a.rawlog: error: the log has no laser scan: it has 2 "
                                          "CObservationBeaconRanges RADIO"));
  auto tilted = scan_at(1);
  tilted.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0.3, 0);
  result = read_rawlog(write(folder, tilted));
  EXPECT_FALSE(result.rawlog);
  EXPECT_THAT(problems(result), HasSubstr("1 scans are of a laser that is tilted"));
}

TEST(RawlogReader, DamagedFilesAreNamedWithTheByte) {
  TemporaryFolder folder;
  EXPECT_THAT(problems(read_rawlog(folder / "none.rawlog")),
              HasSubstr("none.rawlog: error: there is no such file"));
  auto path = folder / "b.rawlog";
  std::ofstream(path).flush();
  EXPECT_THAT(problems(read_rawlog(path)), HasSubstr("the file has no objects"));
  std::ofstream(path) << "This is a text, and long enough to be no header of any object at all.";
  EXPECT_THAT(problems(read_rawlog(path)), HasSubstr("the object at byte 0 cannot be read"));
  // The second of two scans is cut off.
  auto whole = write(folder, scan_at(1));
  auto gzip = [](const std::filesystem::path& from) {
    std::ifstream in{from, std::ios::binary};
    return std::string{std::istreambuf_iterator<char>{in}, {}};
  };
  auto one = gzip(whole);
  std::ofstream(path, std::ios::binary) << one << one.substr(0, one.size() / 2);
  auto text = problems(read_rawlog(path));
  EXPECT_THAT(text, HasSubstr("b.rawlog: error"));
  EXPECT_THAT(text, HasSubstr("at byte "));
  EXPECT_THAT(text, HasSubstr("fetch it again"));
}

TEST(RobotLogFile, IsReadByItsKind) {
  TemporaryFolder folder;
  auto rawlog = read_robot_log(write(folder, scan_at(1)));
  ASSERT_TRUE(rawlog.log) << render(rawlog.diagnostics);
  EXPECT_EQ(rawlog.log->scans.size(), 1U);
  auto path = folder / "a.log";
  std::ofstream(path) << "FLASER 4 1 2 3 4 0 0 0 0 0 0 1.5 host 1.5\n";
  auto carmen = read_robot_log(path);
  ASSERT_TRUE(carmen.log) << render(carmen.diagnostics);
  EXPECT_EQ(carmen.log->scans.at(0).scan.ranges.size(), 4U);
  const std::filesystem::path cloud = "/usr/share/mrpt/datasets/test_velodyne_VLP16.rawlog";
  if (!exists(cloud))
    GTEST_SKIP() << "needs the package mrpt-common";
  auto clouds = read_robot_log(cloud);
  EXPECT_FALSE(clouds.log);
  EXPECT_THAT(render(clouds.diagnostics), HasSubstr("1 clouds of points, but no scan"));
}

/// The rawlogs that Debian's package mrpt-common has.
TEST(RawlogReader, ReadsTheLogsOfMrpt) {
  const std::filesystem::path folder = "/usr/share/mrpt/datasets";
  if (!exists(folder))
    GTEST_SKIP() << "needs the package mrpt-common";
  std::map<std::string, std::size_t> scans;
  for (auto& file : std::filesystem::recursive_directory_iterator(folder)) {
    if (file.path().extension() != ".rawlog")
      continue;
    auto name = file.path().filename().string();
    auto result = read_rawlog(file.path());
    std::cout << name << '\n';
    for (auto& x : result.diagnostics)
      std::cout << "  " << to_string(x.severity) << ": " << x.message << '\n';
    if (!result.rawlog)
      continue;
    auto& log = result.rawlog->log;
    scans[name] = log.scans.size();
    auto duration =
      log.scans.empty()
        ? 0.
        : static_cast<double>(log.scans.back().scan.time - log.scans.front().scan.time) / 1e6;
    std::cout << "  " << log.scans.size() << " scans of "
              << (log.scans.empty() ? 0 : log.scans[0].scan.ranges.size()) << " beams in "
              << duration << " s, " << log.odometry.size() << " odometry, "
              << result.rawlog->clouds.size() << " clouds";
    for (auto& x : result.rawlog->clouds)
      std::cout << " of " << x.points.size() << " points";
    std::cout << '\n';
    for (auto& [content, count] : result.rawlog->contents)
      std::cout << "    " << count << ' ' << content << '\n';
  }
  EXPECT_EQ(scans.at("2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog"), 225U);
  EXPECT_EQ(scans.at("localization_demo.rawlog"), 37U);
  EXPECT_TRUE(scans.contains("test_velodyne_VLP16.rawlog"));
  EXPECT_FALSE(scans.contains("RO-SLAM_demo.rawlog"));
}

} // namespace

} // namespace castor::mapping::test
