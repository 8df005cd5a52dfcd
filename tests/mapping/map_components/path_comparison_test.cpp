// The poses of keyframes beside the true ones.

#include "castor/mapping/map_components/path_comparison.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::mapping::test {

namespace {

TEST(PathComparison, IsEmptyWithoutKeyframes) {
  EXPECT_EQ(PathComparison{}.error(), PathError{});
  EXPECT_TRUE(PathComparison{}.truth().poses.empty());
}

TEST(PathComparison, TruthsAreInterpolatedAtTheTimesOfKeyframes) {
  PathComparison comparison;
  comparison.add_truth(0, {0, 0, 0});
  comparison.add_truth(20, {2, 0, 0.2});
  comparison.place("a", 10, {1, 0.3, 0.1});
  ASSERT_EQ(comparison.truth().poses.size(), 1u);
  EXPECT_NEAR(comparison.truth().poses[0].x, 1, 1e-9);
  auto error = comparison.error();
  EXPECT_EQ(error.keyframes, 1);
  EXPECT_NEAR(error.median, 0.3, 1e-9);
  EXPECT_NEAR(error.most, 0.3, 1e-9);
  EXPECT_NEAR(error.heading_most, 0, 1e-9);
}

TEST(PathComparison, AKeyframeMayComeBeforeTheTruthOfItsTime) {
  PathComparison comparison;
  comparison.add_truth(0, {0, 0, 0});
  comparison.place("a", 10, {1, 0, 0});
  EXPECT_EQ(comparison.error().keyframes, 0);
  comparison.add_truth(20, {2, 0, 0});
  EXPECT_EQ(comparison.error().keyframes, 1);
}

TEST(PathComparison, TruthsOfTheEvaluatorBeforeAreTaken) {
  PathComparison before;
  before.add_truth(0, {0, 0, 0});
  before.add_truth(20, {2, 0, 0});
  before.place("a", 10, {1, 0.3, 0});
  PathComparison comparison;
  comparison.place("a", 10, {1, 0.3, 0});
  comparison.add_truths(before.truth());
  comparison.add_truth(100, {10, 0, 0});
  comparison.add_truth(120, {12, 0, 0});
  comparison.place("b", 50, {5, 0, 0});
  comparison.place("c", 110, {11, 0.1, 0});
  EXPECT_EQ(comparison.error().keyframes, 2) << "nobody knows the truth of b";
  EXPECT_NEAR(comparison.error().most, 0.3, 1e-9);
  EXPECT_EQ(comparison.truth().times, (std::vector<std::int64_t>{10, 110}));
}

TEST(PathComparison, CorrectedPosesReplaceTheFormerOnes) {
  PathComparison comparison;
  comparison.add_truth(0, {0, 0, 0});
  comparison.add_truth(100, {0, 0, 0});
  comparison.place("a", 10, {5, 0, 3.1});
  comparison.place("b", 20, {0.1, 0, -0.2});
  comparison.place("c", 30, {0.2, 0, 0});
  EXPECT_NEAR(comparison.error().most, 5, 1e-9);
  EXPECT_NEAR(comparison.error().median, 0.2, 1e-9);
  comparison.place("a", 10, {0.3, 0, 0.1});
  EXPECT_NEAR(comparison.error().most, 0.3, 1e-9);
  EXPECT_NEAR(comparison.error().heading_most, 0.2, 1e-9);
  comparison.remove("a");
  EXPECT_EQ(comparison.error().keyframes, 2);
}

TEST(PathComparison, AMapThatIsTurnedIsRightAfterAlignment) {
  PathComparison comparison;
  for (int i = 0; i <= 20; ++i) {
    const Pose2 truth{0.5 * i, i < 10 ? 0.0 : 0.3 * (i - 10), 0.1};
    comparison.add_truth(i, truth);
    auto told = compose({0, 0, 0.01}, truth);
    told.x += i == 15 ? 0.05 : 0;
    comparison.place(std::to_string(i), i, told);
  }
  const auto error = comparison.error();
  EXPECT_GT(error.median, 0.03);
  EXPECT_LT(error.aligned_median, 0.005);
  EXPECT_NEAR(error.aligned_most, 0.05, 0.005);
}

TEST(PathComparison, HeadingsAreComparedTheShorterWayRound) {
  PathComparison comparison;
  comparison.add_truth(0, {0, 0, 3.1});
  comparison.add_truth(10, {0, 0, 3.1});
  comparison.place("a", 5, {0, 0, -3.1});
  EXPECT_NEAR(comparison.error().heading_most, 2 * 3.14159265 - 6.2, 1e-6);
}

} // namespace

} // namespace castor::mapping::test
