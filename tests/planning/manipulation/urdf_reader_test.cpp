#include "castor/planning/manipulation/urdf_reader.hpp"

#include <gmock/gmock.h>

#include <numbers>
#include <string>

namespace castor::manipulation {

namespace {

using ::testing::HasSubstr;

const std::string scara = R"(<?xml version="1.0"?>
<robot name="scara">
  <link name="world"/>
  <link name="column">
    <visual><geometry><mesh filename="column.dae"/></geometry></visual>
    <collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.05" length="0.4"/></geometry></collision>
  </link>
  <link name="arm"><collision><geometry><box size="0.3 0.06 0.05"/></geometry></collision></link>
  <link name="quill"><collision><geometry><sphere radius="0.03"/></geometry></collision></link>
  <link name="camera"><collision><geometry><box size="0.1 0.02 0.02"/></geometry></collision></link>
  <joint name="stand" type="fixed"><parent link="world"/><child link="column"/></joint>
  <joint name="shoulder" type="continuous">
    <origin xyz="0 0 0.4"/><parent link="column"/><child link="arm"/>
    <axis xyz="0 0 2"/><limit effort="10" velocity="2"/>
  </joint>
  <joint name="lift" type="prismatic">
    <origin xyz="0.3 0 0" rpy="3.14159265358979 0 0"/><parent link="arm"/><child link="quill"/>
    <axis xyz="0 0 1"/><limit lower="0" upper="0.2" effort="10" velocity="0.5"/>
  </joint>
  <joint name="mount" type="fixed">
    <origin xyz="0 0 0.1"/><parent link="arm"/><child link="camera"/>
  </joint>
</robot>
)";

/// The file with the first `what` replaced.
std::string with(const std::string& what, const std::string& replacement) {
  auto result = scara;
  const auto at = result.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return result.replace(at, what.size(), replacement);
}

UrdfOptions on_quill() {
  UrdfOptions result;
  result.tip = "quill";
  result.tool.position.z = 0.05;
  return result;
}

void expect_error(const std::string& text, std::size_t line, const std::string& message,
                  const std::string& remedy) {
  SCOPED_TRACE(message);
  const auto problems = parse_urdf(text, "arm.urdf", on_quill()).problems;
  ASSERT_EQ(problems.size(), 1u) << render(problems);
  EXPECT_EQ(problems[0].where.line(), line);
  EXPECT_THAT(problems[0].message, HasSubstr(message));
  EXPECT_THAT(problems[0].remedy, HasSubstr(remedy));
}

} // namespace

TEST(UrdfReader, ReadsTheChainToTheTip) {
  const auto [arm, problems] = parse_urdf(scara, "arm.urdf", on_quill());
  ASSERT_TRUE(problems.empty()) << render(problems);
  EXPECT_EQ(arm.name, "scara");
  ASSERT_EQ(arm.links.size(), 4u);
  EXPECT_EQ(arm.links[1].shapes.at(0).solid, cylinder(0.1, 0.4));
  ASSERT_EQ(arm.joints.size(), 3u);
  EXPECT_EQ(arm.joints[0].kind, JointKind::fixed);
  EXPECT_EQ(arm.joints[1].upper, std::numbers::pi);
  EXPECT_EQ(arm.joints[1].axis, (Point3{0, 0, 1}));
  EXPECT_EQ(arm.joints[1].acceleration, 4);
  EXPECT_EQ(arm.joints[2].kind, JointKind::sliding);
  EXPECT_NEAR(arm.joints[2].origin.rotation.x, 1, 1e-12);
  EXPECT_EQ(arm.tool.position.z, 0.05);
  EXPECT_EQ(arm.home, (Configuration{0, 0}));
}

TEST(UrdfReader, LinksBesideTheChainBelongToTheLinkThatCarriesThem) {
  const auto arm = parse_urdf(scara, "arm.urdf", on_quill()).arm;
  ASSERT_EQ(arm.links.at(2).shapes.size(), 2u);
  EXPECT_EQ(arm.links[2].shapes[1].solid, box(0.1, 0.02, 0.02));
  EXPECT_EQ(arm.links[2].shapes[1].pose.position.z, 0.1);
}

TEST(UrdfReader, NamesLineAndRemedyOfWhatIsWrong) {
  expect_error(with("type=\"continuous\"", "type=\"floating\""), 12, "\"floating\"", "revolute");
  expect_error(with("radius=\"0.05\"", "radius=\"${r}\""), 6, "\"${r}\"", "xacro");
  expect_error(with("radius=\"0.05\"", "radius=\"-1\""), 6, "radius of <cylinder> is -1",
               "more than 0");
  expect_error(with("xyz=\"0 0 0.4\"", "xyz=\"0 0\""), 13, "fewer than three", "three");
  expect_error(with("velocity=\"0.5\"", ""), 18, "no attribute \"velocity\"", "velocity=");
  expect_error(with("upper=\"0.2\"", ""), 18, "not below the upper", "fixed");
  expect_error(with("<link name=\"world\"/>", ""), 11, "world, which is not there",
               "<link name=\"world\"/>");
  expect_error(with("<link name=\"world\"/>", "<xacro:arm/>"), 3, "xacro", "xacro FILE");
  expect_error(with("</robot>", ""), 2, "no XML", "Close");
  expect_error(with("child link=\"camera\"", "child link=\"quill\""), 20, "two parents", "line 16");
  expect_error("<sdf/>", 0, "no <robot>", "<robot name");
}

TEST(UrdfReader, AsksForTheTipWhereThereAreSeveral) {
  const auto problems = parse_urdf(scara, "arm.urdf").problems;
  ASSERT_EQ(problems.size(), 1u) << render(problems);
  EXPECT_THAT(problems[0].remedy, HasSubstr("camera, quill"));
}

TEST(UrdfReader, WarnsOfMeshes) {
  const auto problems =
    parse_urdf(with("<sphere radius=\"0.03\"/>", "<mesh filename=\"quill.stl\"/>"), "arm.urdf",
               on_quill())
      .problems;
  ASSERT_EQ(problems.size(), 1u) << render(problems);
  EXPECT_EQ(problems[0].severity, Severity::warning);
  EXPECT_EQ(problems[0].where.line(), 9u);
  EXPECT_THAT(problems[0].message, HasSubstr("quill"));
}

TEST(UrdfReader, RefusesLinksThatCarryThemselves) {
  auto text = with("<parent link=\"world\"/><child link=\"column\"/>",
                   "<parent link=\"quill\"/><child link=\"column\"/>");
  const auto problems = parse_urdf(text, "arm.urdf", on_quill()).problems;
  ASSERT_EQ(problems.size(), 1u) << render(problems);
  EXPECT_THAT(problems[0].message, HasSubstr("cycle"));
}

} // namespace castor::manipulation
