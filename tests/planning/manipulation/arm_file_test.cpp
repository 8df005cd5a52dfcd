#include "castor/planning/manipulation/arm_file.hpp"

#include "castor/planning/manipulation/joint_watch.hpp"

#include <gmock/gmock.h>

#include <numbers>
#include <string>

namespace castor::manipulation {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;

const std::string small_arm =
  "arm small\n"
  "base stand\n"
  "shape cylinder 12cm 0.2 at 0 0 0.1\n"
  "joint shoulder moves upper at 0 0 0.2 axis y from -30 to 90 speed 60 "
  "acceleration 120\n"
  "shape capsule 0.06 0.25 at 0 0 0.095\n"
  "slide lift moves carriage at 0 0 190mm axis 0 0 -2e-1 from 0 to 0.4 "
  "speed 0.2 acceleration 0.5\n"
  "fixed wrist carries hand at 0 0 0.1 turned 0 90 0\n"
  "shape box 0.04 0.1 0.03\n"
  "tool at 0 0 0.15\n"
  "gripper opens 0.01 to 0.1 speed 0.1 fingers 0.02 0.012 0.07 beyond 0.01\n"
  "home 20 0.1\n";

/// The small arm with another line.
std::string with_line(int number, const std::string& text) {
  std::string result;
  int line = 1;
  for (std::size_t begin = 0; begin < small_arm.size(); ++line) {
    const auto end = small_arm.find('\n', begin) + 1;
    result += line == number ? text + "\n" : small_arm.substr(begin, end - begin);
    begin = end;
  }
  return result;
}

/// What is wrong after that change: one problem, in that line.
void expect_problem(int number, const std::string& text, const std::string& message,
                    const std::string& remedy) {
  SCOPED_TRACE(text);
  const auto result = parse_arm(with_line(number, text), "my.arm");
  ASSERT_EQ(result.problems.size(), 1u) << render(result.problems);
  EXPECT_EQ(result.problems[0].where.file(), "my.arm");
  EXPECT_EQ(result.problems[0].where.line(), static_cast<std::size_t>(number));
  EXPECT_EQ(result.problems[0].severity, Severity::error);
  EXPECT_THAT(result.problems[0].message, HasSubstr(message));
  EXPECT_THAT(result.problems[0].remedy, HasSubstr(remedy));
}

} // namespace

TEST(ArmFile, DescribesAChainOfLinks) {
  const auto [arm, problems] = parse_arm(small_arm, "my.arm");
  ASSERT_TRUE(problems.empty()) << render(problems);
  EXPECT_EQ(arm.name, "small");
  ASSERT_EQ(arm.links.size(), 4u);
  ASSERT_EQ(arm.joints.size(), 3u);
  EXPECT_EQ(arm.links[0].shapes.at(0).solid, cylinder(0.12, 0.2));
  EXPECT_EQ(arm.links[1].name, "upper");
  EXPECT_EQ(arm.joints[0].kind, JointKind::turning);
  EXPECT_NEAR(arm.joints[0].lower, -30 * degree, 1e-12);
  EXPECT_NEAR(arm.joints[0].acceleration, 120 * degree, 1e-12);
  EXPECT_EQ(arm.joints[1].kind, JointKind::sliding);
  EXPECT_NEAR(arm.joints[1].axis.z, -1, 1e-12);
  EXPECT_EQ(arm.joints[1].upper, 0.4);
  EXPECT_EQ(arm.joints[2].kind, JointKind::fixed);
  EXPECT_NEAR(arm.joints[2].origin.rotation.y, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(arm.tool.position.z, 0.15);
  ASSERT_TRUE(arm.gripper);
  EXPECT_EQ(arm.gripper->widest, 0.1);
  EXPECT_THAT(moving_joints(arm), ElementsAre(0, 1));
  EXPECT_NEAR(arm.home.at(0), 20 * degree, 1e-12);
  EXPECT_EQ(arm.home.at(1), 0.1);
}

TEST(ArmFile, NamesLineAndRemedyOfWhatIsWrong) {
  expect_problem(1, "arn small", "not the beginning of a statement", "arm");
  expect_problem(3, "shape cone 1 2", "\"cone\" is no shape", "box, cylinder, capsule, sphere");
  expect_problem(5, "shape capsule 0.06 0.05", "shorter than its diameter", "0.06");
  expect_problem(4, "joint a moves b at 0 0 0 axis 0 0 0 from 0 to 1 speed 1 acceleration 1",
                 "no direction", "x, y or z");
  expect_problem(4, "joint a moves b at 0 0 0 axis y from 50 to 20 speed 1 acceleration 1",
                 "not below the upper", "lower one first");
  expect_problem(4, "joint a moves b at 0 0 0 axis y from 0 to 20 speed 0 acceleration 1",
                 "speed of a joint that moves is 0", "fixed");
  expect_problem(4, "joint a moves b at 0 0 0 axis y from 0 to 20 speed 1", "acceleration",
                 "joint elbow");
  expect_problem(6, "slide lift moves upper at 0 0 0 axis z from 0 to 1 speed 1 acceleration 1",
                 "upper is given twice", "line 4");
  expect_problem(10, "gripper opens 0.1 to 0.05 speed 1 fingers 0.02 0.01 0.07 beyond 0.01",
                 "not below the largest", "opens 0 to");
  expect_problem(11, "home 120 0.1", "beyond its limits", "-30 to 90");
  expect_problem(11, "home 20", "the line ends", "lift");
  expect_problem(11, "home 20 0.1 5", "one word too many", "Remove");
}

TEST(ArmFile, FindsAllProblemsAtOnce) {
  const auto result = parse_arm("arm a\nshape box 1 1 1\njoint\nfoo\narm b\n", "my.arm");
  std::vector<std::size_t> lines;
  for (const auto& x : result.problems)
    lines.push_back(x.where.line());
  EXPECT_THAT(lines, ElementsAre(2, 3, 4, 5)) << render(result.problems);
}

TEST(ArmFile, SaysWhatIsMissing) {
  const auto result = parse_arm("base stand\n", "my.arm");
  ASSERT_EQ(result.problems.size(), 4u) << render(result.problems);
  EXPECT_THAT(render(result.problems), HasSubstr("no joint that moves"));
  EXPECT_THAT(render(result.problems), HasSubstr("no \"tool\" line"));
  EXPECT_THAT(render(result.problems), HasSubstr("collides with nothing"));
}

TEST(ArmFile, DescribesTheKatana) {
  const auto [arm, problems] = load_arm(std::string(CASTOR_CONFIGS) + "/arms/katana.arm");
  EXPECT_TRUE(problems.empty()) << render(problems);
  EXPECT_EQ(moving_joints(arm).size(), 5u);
  // From the shoulder, and the turret below it.
  EXPECT_NEAR(reach(arm), 0.642 + 0.1015, 0.001);
  EXPECT_TRUE(within_limits(arm, arm.home));
}

TEST(ArmModel, KnowsLimitsOfItsJoints) {
  const auto arm = parse_arm(small_arm, "my.arm").arm;
  EXPECT_TRUE(within_limits(arm, std::vector{-30 * degree, 0.4}));
  EXPECT_FALSE(within_limits(arm, std::vector{-30.1 * degree, 0.4}));
  EXPECT_FALSE(within_limits(arm, std::vector{0.0, 0.41}));
  EXPECT_FALSE(within_limits(arm, std::vector{0.0}));
}

TEST(ArmModel, AJointThatStandsStillKeepsItsNumber) {
  const auto arm = with_still_joint(parse_arm(small_arm, "my.arm").arm, 1, 0.1);
  EXPECT_TRUE(within_limits(arm, std::vector{0.0, 0.1}));
  EXPECT_FALSE(within_limits(arm, std::vector{0.0, 0.2}));
  EXPECT_EQ(kept_within_limits(arm, {-90 * degree, 0.2}), (Configuration{-30 * degree, 0.1}));
  const auto moving = moving_joints(arm);
  EXPECT_FALSE(stands_still(arm.joints[moving[0]]));
  EXPECT_TRUE(stands_still(arm.joints[moving[1]]));
  EXPECT_THROW(with_still_joint(arm, 2, 0), std::out_of_range);
}

TEST(JointWatch, TellsAJointThatDoesNotMoveFromOneThatSticksForAMoment) {
  JointWatch watch;
  EXPECT_FALSE(watch.did_not_follow("lift", 0.3));
  // It has moved meanwhile.
  EXPECT_FALSE(watch.did_not_follow("lift", 0.4));
  EXPECT_FALSE(watch.did_not_follow("turret", 0.4));
  EXPECT_FALSE(watch.did_not_follow("lift", 0.4));
  EXPECT_TRUE(watch.did_not_follow("lift", 0.4));
}

TEST(ArmModel, FingersAreAsFarApartAsTheGripperIsOpen) {
  const auto arm = parse_arm(small_arm, "my.arm").arm;
  const auto both = fingers(arm, 0.06);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[0].pose.position.y - both[0].solid.size.y / 2, 0.03, 1e-12);
  EXPECT_NEAR(both[1].pose.position.y + both[1].solid.size.y / 2, -0.03, 1e-12);
  EXPECT_NEAR(both[0].pose.position.z + both[0].solid.size.z / 2, 0.01, 1e-12);
}

} // namespace castor::manipulation
