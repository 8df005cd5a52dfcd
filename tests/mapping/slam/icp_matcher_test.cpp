#include "castor/mapping/slam/icp_matcher.hpp"

#include "castor/mapping/slam/front_end.hpp"
#include "castor/tests/mapping/slam/simulated_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace castor::mapping::test {

namespace {

TEST(IcpMatcher, AlignsAScan) {
  const auto walls = furnished_room();
  std::mt19937 random{1};
  const Pose2 here{2, 1.7, 0.3};
  const Pose2 there{2.2, 1.8, 0.4};
  PointMap map{surface_points(with_noise(scan_from(walls, here), 0.01, random))};
  auto scan = surface_points(with_noise(scan_from(walls, there), 0.01, random));
  auto match = IcpMatcher{}.match(map, scan, {0.1, 0, 0});
  const auto truth = between(here, there);
  EXPECT_LT(distance(match.pose, truth), 0.05);
  EXPECT_LT(std::abs(normalised(match.pose.heading - truth.heading)), 0.03);
  EXPECT_GT(match.matched, 0.7);
  EXPECT_GT(match.covariance.xx, 0);
}

TEST(IcpMatcher, WithoutPointsThePoseIsTheGuess) {
  const Pose2 guess{1, 2, 3};
  auto match = IcpMatcher{}.match(PointMap{}, {}, guess);
  EXPECT_EQ(match.pose, guess);
  EXPECT_EQ(match.matched, 0);
}

TEST(IcpMatcher, AFrontEndWithItFollowsTheRobot) {
  const auto walls = furnished_room();
  const auto path = path_around(1);
  const auto odometry = odometry_of(path, 0.05);
  std::mt19937 random{3};
  FrontEndOptions options;
  options.method = MatchingMethod::icp;
  FrontEnd front_end{options};
  double worst = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    auto scan =
      with_noise(scan_from(walls, path[i], static_cast<std::int64_t>(i) * 100000), 0.01, random);
    worst = std::max(worst, distance(in_map(path, i), front_end.add(scan, odometry[i]).local_pose));
  }
  EXPECT_LT(worst, 0.3);
}

} // namespace

} // namespace castor::mapping::test
