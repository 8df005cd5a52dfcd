#include "castor/mapping/movement/free_arc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace castor::mapping {

namespace {

TEST(FreeArc, EndsBeforeAPoint) {
  const std::vector<Point2> points{{2, 0.1}};
  EXPECT_NEAR(free_arc({0, 0, 0}, {0.5, 0}, points, 0.25, 0.05, 5), 2 - std::sqrt(0.09 - 0.01),
              0.021);
  EXPECT_EQ(free_arc({0, 0, 0}, {0.5, 0}, points, 0.25, 0.05, 1), 1);
  EXPECT_EQ(free_arc({0, 0, 0}, {0.5, 0.5}, points, 0.25, 0.05, 2), 2);
  EXPECT_EQ(free_arc({0, 0, 0}, {-0.5, 0}, points, 0.25, 0.05, 5), 5);
}

TEST(FreeArc, LetsADiscAwayFromAPointThatIsTooNear) {
  const std::vector<Point2> points{{0.26, 0}};
  EXPECT_EQ(free_arc({0, 0, 0}, {0.5, 0}, points, 0.25, 0.05, 1), 0);
  EXPECT_EQ(free_arc({0, 0, 0}, {-0.5, 0}, points, 0.25, 0.05, 1), 1);
}

} // namespace

} // namespace castor::mapping
