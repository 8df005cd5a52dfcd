// CARMEN logs, written by hand.

#include "castor/mapping/logs/carmen_log.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <string>

namespace castor::mapping::test {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using std::numbers::pi;

RobotLogResult parse(const std::string& text, const CarmenLogOptions& options = {}) {
  return parse_carmen_log(text, "robot.log", options);
}

// A line with four beams.
std::string flaser(const std::string& time, const std::string& ranges = "1.0 2.0 3.0 4.0") {
  return "FLASER 4 " + ranges + " 1.5 2 0.1 1.5 2 0.1 " + time + " robot " + time + "\n";
}

void expect_error(const RobotLogResult& result, std::size_t line, const std::string& message) {
  EXPECT_FALSE(result.log);
  ASSERT_FALSE(result.diagnostics.empty());
  const auto& x = result.diagnostics.front();
  EXPECT_EQ(x.severity, Severity::error);
  EXPECT_EQ(x.where.file(), "robot.log");
  EXPECT_EQ(x.where.line(), line) << x.message;
  EXPECT_THAT(x.message, HasSubstr(message));
  EXPECT_NE(x.remedy, "");
}

TEST(CarmenLog, AScanHasTheOdometryOfItsTime) {
  auto result = parse("# comment\n" + flaser("100.25") + flaser("100.5", "1 81.91 3 80"));
  ASSERT_TRUE(result.log);
  EXPECT_TRUE(result.diagnostics.empty());
  ASSERT_EQ(result.log->scans.size(), 2U);
  const auto& first = result.log->scans[0];
  EXPECT_EQ(first.scan.time, 100250000);
  EXPECT_EQ(first.odometry.time, 100250000);
  EXPECT_EQ(first.odometry.pose, (Pose2{1.5, 2, 0.1}));
  EXPECT_THAT(first.scan.ranges, ElementsAre(1, 2, 3, 4));
  EXPECT_DOUBLE_EQ(first.scan.first_angle, -pi / 2);
  EXPECT_DOUBLE_EQ(first.scan.angle_step, pi / 4);
  EXPECT_LT(distance(first.scan.mount, Pose2{}), 1e-9);
  // Nothing came back.
  EXPECT_THAT(result.log->scans[1].scan.ranges, ElementsAre(1, 0, 3, 0));
}

TEST(CarmenLog, AnOddNumberOfBeamsReachesBothEndsOfTheHalfTurn) {
  auto result = parse("FLASER 5 1 1 1 1 1 0 0 0 0 0 0 1 robot 1\n");
  ASSERT_TRUE(result.log);
  const auto& scan = result.log->scans[0].scan;
  EXPECT_DOUBLE_EQ(scan.first_angle + 4 * scan.angle_step, pi / 2);
}

TEST(CarmenLog, AParameterHasTheFieldOfView) {
  auto result = parse("PARAM laser_front_laser_fov 100 1 robot 1\n" + flaser("2"));
  ASSERT_TRUE(result.log);
  EXPECT_NEAR(result.log->scans[0].scan.first_angle, -50 * pi / 180, 1e-12);
}

TEST(CarmenLog, TheScannerIsMountedWhereItsPosesAreOnTheRobot) {
  auto ahead = compose(Pose2{1, 2, 0.5}, Pose2{0.25, 0, 0});
  auto numbers = std::to_string(ahead.x) + " " + std::to_string(ahead.y) + " 0.5 1 2 0.5";
  auto result = parse("FLASER 2 1 1 " + numbers + " 1 robot 1\n");
  ASSERT_TRUE(result.log);
  EXPECT_NEAR(result.log->scans[0].scan.mount.x, 0.25, 1e-5);
  EXPECT_NEAR(result.log->scans[0].scan.mount.y, 0, 1e-5);
}

TEST(CarmenLog, ACorrectedPathIsNoMount) {
  auto result = parse("FLASER 2 1 1 7 8 0.5 1 2 0.5 1 robot 1\n");
  ASSERT_TRUE(result.log);
  EXPECT_EQ(result.log->scans[0].scan.mount, Pose2{});
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_EQ(result.diagnostics[0].severity, Severity::note);
}

TEST(CarmenLog, AParameterHasTheMount) {
  auto result = parse("PARAM robot_frontlaser_offset 0.3 1 robot 1\n" + flaser("2"));
  ASSERT_TRUE(result.log);
  EXPECT_EQ(result.log->scans[0].scan.mount, (Pose2{0.3, 0, 0}));
}

TEST(CarmenLog, LinesOfOdometryAreBesideThatOfScans) {
  auto result = parse("ODOM 1 2 0.5 0.4 0.1 0 7.5 robot 7.5\n" + flaser("8"));
  ASSERT_TRUE(result.log);
  ASSERT_EQ(result.log->odometry.size(), 1U);
  EXPECT_EQ(result.log->odometry[0], (Odometry{7500000, {1, 2, 0.5}, {0.4, 0.1}}));
}

TEST(CarmenLog, RobotLaserSaysItsAngles) {
  auto line = "ROBOTLASER1 0 -1.2 2.4 0.8 20 0.01 0 4 1 2 30 4 1 77 0.5 0 0 0.3 0 0 0.1 0.2 0 0 0 "
              "5 robot 5\n";
  auto result = parse(flaser("4") + line);
  ASSERT_TRUE(result.log);
  // They count, and not those of FLASER.
  ASSERT_EQ(result.log->scans.size(), 1U);
  const auto& x = result.log->scans[0];
  EXPECT_DOUBLE_EQ(x.scan.first_angle, -1.2);
  EXPECT_DOUBLE_EQ(x.scan.angle_step, 0.8);
  EXPECT_DOUBLE_EQ(x.scan.max_range, 20);
  EXPECT_THAT(x.scan.ranges, ElementsAre(1, 2, 0, 4));
  EXPECT_NEAR(x.scan.mount.x, 0.2, 1e-12);
  EXPECT_EQ(x.odometry.velocity, (Twist2{0.1, 0.2}));
  EXPECT_EQ(x.scan.time, 5000000);
}

TEST(CarmenLog, TimesOfMessagesThatWereLoggedLateAreSetBack) {
  auto result = parse(flaser("1") + flaser("2.5") + flaser("2.0") + flaser("3"));
  ASSERT_TRUE(result.log);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_EQ(result.diagnostics[0].severity, Severity::warning);
  EXPECT_EQ(result.diagnostics[0].where.line(), 3U);
  EXPECT_EQ(result.log->scans[1].scan.time, 2000000);
  EXPECT_EQ(result.log->scans[1].odometry.time, 2000000);
  EXPECT_EQ(result.log->scans[1].logged_time, 2500000);
  EXPECT_EQ(result.log->scans[2].scan.time, 2000000);
}

TEST(CarmenLog, ALineThatIsCutOff) {
  expect_error(parse(flaser("1") + "FLASER 4 1.0 2.0\n"), 2, "cut off");
  expect_error(parse("FLASER 2 1 1 0 0 0 0 0 0\n"), 1, "cut off");
}

TEST(CarmenLog, ARangeThatIsNoNumber) {
  expect_error(parse(flaser("1", "1 nan 3 4")), 1, "range 2 of 4 is NaN");
  expect_error(parse(flaser("1", "1 2 -3 4")), 1, "range 3 of 4 is negative");
  expect_error(parse(flaser("1", "1 2 x 4")), 1, "'x' is no number");
}

TEST(CarmenLog, TimeThatRunsBackwardByMoreThanMessagesAreLate) {
  expect_error(parse(flaser("10") + flaser("7.5")), 2, "time runs backward by 2.5");
}

TEST(CarmenLog, ANumberOfBeamsThatChanges) {
  expect_error(parse(flaser("1") + "FLASER 2 1 1 0 0 0 0 0 0 2 robot 2\n"), 2,
               "2 beams after one of 4");
}

TEST(CarmenLog, ALogWithoutLaser) {
  expect_error(parse("ODOM 1 2 0.5 0.4 0.1 0 7.5 robot 7.5\n"), 0, "no scans");
  expect_error(parse(""), 0, "no scans");
}

TEST(CarmenLog, BadLinesAreSkippedOnDemand) {
  CarmenLogOptions options;
  options.skip_bad_lines = true;
  auto result = parse(flaser("1") + "FLASER 4 1.0 2.0\n" + flaser("2"), options);
  ASSERT_TRUE(result.log);
  EXPECT_EQ(result.log->scans.size(), 2U);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_EQ(result.diagnostics[0].severity, Severity::warning);
}

TEST(CarmenLog, ManyBadLinesAreCounted) {
  std::string text;
  for (int i = 0; i < 100; ++i)
    text += "FLASER 4 1.0\n";
  auto result = parse(text);
  EXPECT_FALSE(result.log);
  ASSERT_EQ(result.diagnostics.size(), 21U);
  EXPECT_THAT(result.diagnostics.back().message, HasSubstr("80 more lines"));
}

TEST(CarmenLog, AFileThatIsMissing) {
  auto result = read_carmen_log("/nowhere/robot.log");
  EXPECT_FALSE(result.log);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_THAT(result.diagnostics[0].message, HasSubstr("no such file"));
}

TEST(CarmenLog, RealLogs) {
  std::filesystem::path folder{CASTOR_SLAM_LOGS};
  if (!exists(folder / "mit-csail.clf.gz"))
    GTEST_SKIP() << "there are no logs in " << folder;
  auto mit = read_carmen_log(folder / "mit-csail.clf.gz");
  ASSERT_TRUE(mit.log);
  EXPECT_EQ(mit.log->scans.size(), 1988U);
  EXPECT_EQ(mit.log->scans[0].scan.ranges.size(), 361U);
  auto intel = read_carmen_log(folder / "intel-first1088s.log.gz");
  ASSERT_TRUE(intel.log);
  EXPECT_EQ(intel.log->scans.size(), 5505U);
}

} // namespace

} // namespace castor::mapping::test
