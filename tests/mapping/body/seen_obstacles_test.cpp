#include "castor/mapping/body/seen_obstacles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>

namespace castor::mapping {

namespace {

LaserScan three_beams(std::int64_t time, float middle) {
  return {time, {}, -0.5, 0.5, 10, {0, middle, 0}};
}

TEST(SeenObstacles, RemembersWhatItDoesNotSeeAnyMore) {
  SeenObstacles seen;
  seen.add(three_beams(0, 2), {1, 1, 0});
  ASSERT_EQ(seen.points().size(), 1u);
  EXPECT_NEAR(seen.points()[0].x, 3, 1e-6);
  // It turns away.
  seen.add(three_beams(1'000'000, 0), {1, 1, 2});
  EXPECT_EQ(seen.points().size(), 1u);
  seen.add(three_beams(3'100'000, 0), {1, 1, 2});
  EXPECT_THAT(seen.points(), testing::IsEmpty());
}

TEST(SeenObstacles, ForgetsWhatABeamGoesThrough) {
  SeenObstacles seen;
  seen.add(three_beams(0, 2), {1, 1, 0});
  seen.add(three_beams(100'000, 2.08F), {1, 1, 0});
  EXPECT_EQ(seen.points().size(), 2u);
  seen.add(three_beams(200'000, 3.5F), {1, 1, 0});
  ASSERT_EQ(seen.points().size(), 1u);
  EXPECT_NEAR(seen.points()[0].x, 4.5, 1e-6);
}

} // namespace

} // namespace castor::mapping
