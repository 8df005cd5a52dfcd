#include "castor/planning/manipulation/arm_placement.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace castor::manipulation {

TEST(ArmPlacement, IsAPlaceWithAHeading) {
  const auto pose = arm_placement("0.1 -37cm heading 90");
  EXPECT_DOUBLE_EQ(pose.position.x, 0.1);
  EXPECT_DOUBLE_EQ(pose.position.y, -0.37);
  EXPECT_EQ(pose.frame, "table");
  const auto ahead = geometry::rotate(pose.rotation, Point3{1, 0, 0});
  EXPECT_NEAR(ahead.y, 1, 1e-12);
  EXPECT_EQ(arm_placement("1 2").rotation, geometry::Rotation{});
}

TEST(ArmPlacement, SaysWhatIsWrong) {
  for (const auto* text : {"", "1", "1 2 heading", "1 2 3", "a b"})
    EXPECT_THROW(arm_placement(text), std::invalid_argument) << text;
}

TEST(ArmPosture, HasANumberOfDegreesForEachJoint) {
  const auto arm = katana();
  EXPECT_EQ(arm_posture(arm, ""), arm.home);
  const auto posture = arm_posture(arm, "90 0 -90 10 0");
  EXPECT_NEAR(posture[0], std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(posture[2], -std::numbers::pi / 2, 1e-12);
  EXPECT_THROW(arm_posture(arm, "90 0 -90 10"), std::invalid_argument);
  EXPECT_THROW(arm_posture(arm, "90 0 -90 10 0 0"), std::invalid_argument);
  EXPECT_THROW(arm_posture(arm, "180 0 0 0 0"), std::invalid_argument) << "beyond a limit";
}

} // namespace castor::manipulation
