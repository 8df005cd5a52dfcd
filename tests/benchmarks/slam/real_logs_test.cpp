// Real logs, by the SLAM benchmark's metric.

#include "castor/benchmarks/slam/relations.hpp"
#include "castor/mapping/logs/carmen_log.hpp"
#include "castor/mapping/slam/slam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace castor::slam_benchmark::test {

namespace {

RelationErrors errors_of(const std::filesystem::path& log_file,
                         const std::filesystem::path& relations_file) {
  auto log = mapping::read_carmen_log(log_file).log.value();
  auto relations = read_relations(relations_file).relations.value();
  mapping::Slam slam;
  for (const auto& x : log.scans)
    slam.add(x.scan, x.odometry.pose);
  slam.finish();
  auto poses = slam.path();
  std::vector<TimedPose> path;
  for (std::size_t i = 0; i < poses.size(); ++i)
    path.push_back({log.scans[i].logged_time, poses[i].pose});
  std::stable_sort(path.begin(), path.end(),
                   [](const TimedPose& a, const TimedPose& b) { return a.time < b.time; });
  return relation_errors(path, relations);
}

class RealLogs : public ::testing::Test {
protected:
  void SetUp() override {
#ifndef NDEBUG
    GTEST_SKIP() << "takes minutes without optimisation";
#endif
    if (!exists(folder / "mit-csail.clf.gz"))
      GTEST_SKIP() << "there are no logs in " << folder;
  }

  std::filesystem::path folder{CASTOR_SLAM_LOGS};
};

constexpr double degrees = std::numbers::pi / 180;

} // namespace

TEST_F(RealLogs, MitCsail) {
  auto errors = errors_of(folder / "mit-csail.clf.gz", folder / "mit-csail.relations.gz");
  EXPECT_EQ(errors.relations, 1172U);
  EXPECT_LT(errors.translation.mean, 0.032);
  EXPECT_LT(errors.rotation.mean, 0.4 * degrees);
}

TEST_F(RealLogs, IntelPrefix) {
  auto errors = errors_of(folder / "intel-first1088s.log.gz", folder / "intel.relations.gz");
  EXPECT_GT(errors.relations, 1000U);
  EXPECT_LT(errors.translation.mean, 0.0165);
  EXPECT_LT(errors.rotation.mean, 0.35 * degrees);
}

} // namespace castor::slam_benchmark::test
