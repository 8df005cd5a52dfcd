#include "castor/benchmarks/manipulation/physics/physics_model.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace castor::manipulation {

namespace {

/// Bits that say what touches what: parts of the arm only things, and things everything.
constexpr const char* of_arm = "contype=\"1\" conaffinity=\"2\"";
constexpr const char* of_thing = "contype=\"2\" conaffinity=\"3\"";

std::string placed(const Pose& pose) {
  const auto& p = pose.position;
  const auto& r = pose.rotation;
  return fmt::format("pos=\"{} {} {}\" quat=\"{} {} {} {}\"", p.x, p.y, p.z, r.w, r.x, r.y, r.z);
}

/// Half of what a solid's lengths are, in MuJoCo's order.
std::string shape(const Solid& x) {
  const double radius = x.size.x / 2;
  switch (x.kind) {
    case SolidKind::box:
      return fmt::format("type=\"box\" size=\"{} {} {}\"", radius, x.size.y / 2, x.size.z / 2);
    case SolidKind::cylinder:
      return fmt::format("type=\"cylinder\" size=\"{} {}\"", radius, x.size.z / 2);
    case SolidKind::capsule:
      return fmt::format("type=\"capsule\" size=\"{} {}\"", radius, x.size.z / 2 - radius);
    case SolidKind::sphere:
      return fmt::format("type=\"sphere\" size=\"{}\"", radius);
  }
  return {};
}

std::string geom(const std::string& name, const PlacedSolid& x, const std::string& more) {
  return fmt::format("<geom name=\"{}\" {} {} {}/>", name, shape(x.solid), placed(x.pose), more);
}

/// Slides along y of the tool's frame, away from the other one.
std::string finger(std::size_t index, const PlacedSolid& closed, const Gripper& gripper) {
  const double side = closed.pose.position.y < 0 ? -1 : 1;
  return fmt::format(
    "<body name=\"{0}\" {1}><joint name=\"{0}\" type=\"slide\" axis=\"0 {2} 0\" "
    "range=\"0 {3}\" damping=\"40\" armature=\"0.2\"/>{4}</body>",
    finger_joint(index), placed(closed.pose), side, gripper.widest / 2,
    geom(finger_joint(index), {closed.solid, {}}, std::string{of_arm} + " class=\"finger\""));
}

std::string hand(const ArmModel& arm) {
  std::string result = fmt::format("<body name=\"tool\" {}>", placed(arm.tool));
  const auto closed = fingers(arm, 0);
  for (std::size_t i = 0; i < closed.size(); ++i)
    result += finger(i, closed[i], *arm.gripper);
  // A body needs a mass.
  return result + "<inertial pos=\"0 0 0\" mass=\"0.05\" diaginertia=\"1e-4 1e-4 1e-4\"/></body>";
}

/// The link of this index, and what it carries.
std::string link(const ArmModel& arm, std::size_t index) {
  const auto& x = arm.links[index];
  const auto& joint = arm.joints[index - 1];
  auto result = fmt::format("<body name=\"{}\" {}>", x.name, placed(joint.origin));
  if (joint.kind != JointKind::fixed)
    result += fmt::format(
      "<joint name=\"{}\" type=\"{}\" axis=\"{} {} {}\" damping=\"{}\" armature=\"1\"/>",
      joint.name, joint.kind == JointKind::turning ? "hinge" : "slide", joint.axis.x, joint.axis.y,
      joint.axis.z, joint_damping);
  for (std::size_t i = 0; i < x.shapes.size(); ++i)
    result += geom(fmt::format("{}{}", x.name, i == 0 ? "" : fmt::format(" {}", i + 1)),
                   x.shapes[i], of_arm);
  result += index + 1 < arm.links.size() ? link(arm, index + 1) : hand(arm);
  return result + "</body>\n";
}

std::string body(const NamedSolid& x, const PhysicsOptions& options) {
  return fmt::format("<body name=\"{}\" {}><freejoint/>{}</body>\n", x.name, placed(x.pose),
                     geom(x.name, {x.solid, {}},
                          fmt::format("{} condim=\"6\" density=\"{}\" friction=\"{} 0.005 0.0005\"",
                                      of_thing, options.density, options.friction)));
}

std::string motors(const ArmModel& arm, const PhysicsOptions& options) {
  std::string result;
  for (auto i : moving_joints(arm))
    result +=
      fmt::format("<position joint=\"{}\" kp=\"{}\"/>\n", arm.joints[i].name, joint_stiffness);
  for (std::size_t i = 0; i < 2; ++i)
    result += fmt::format("<position joint=\"{0}\" kp=\"4000\" forcelimited=\"true\" "
                          "forcerange=\"-{1} {1}\"/>\n",
                          finger_joint(i), options.grip);
  return result;
}

} // namespace

std::string finger_joint(std::size_t finger) {
  return fmt::format("finger {}", finger + 1);
}

std::string physics_model(const ArmModel& arm, const Scene& scene, const PhysicsOptions& options) {
  if (!arm.gripper || arm.links.size() < 2)
    throw std::invalid_argument("the arm " + arm.name + " has no gripper");
  if (scene.things.empty())
    throw std::invalid_argument("there is no table");
  auto result = fmt::format(
    "<mujoco model=\"{}\">\n<compiler angle=\"radian\" autolimits=\"true\"/>\n"
    "<option timestep=\"{}\" cone=\"elliptic\" impratio=\"10\"/>\n"
    "<default><default class=\"finger\"><geom condim=\"6\" friction=\"{} 0.02 0.001\"/></default>"
    "</default>\n<worldbody>\n",
    arm.name, options.step, options.finger_friction);
  const auto& table = scene.things.front();
  // MuJoCo takes small boxes on a very large one for deep in it; a plane is exact.
  result += fmt::format("<geom name=\"{}\" type=\"plane\" size=\"{} {} 1\" pos=\"0 0 {}\" {} "
                        "friction=\"{} 0.005 0.0005\"/>",
                        table.name, table.solid.size.x / 2, table.solid.size.y / 2,
                        table.pose.position.z + table.solid.size.z / 2, of_thing, options.friction);
  for (std::size_t i = 0; i < arm.links.front().shapes.size(); ++i)
    result += geom(fmt::format("{} {}", arm.links.front().name, i + 1), arm.links.front().shapes[i],
                   of_arm);
  result += link(arm, 1);
  for (std::size_t i = 1; i < scene.things.size(); ++i)
    result += body(scene.things[i], options);
  return result + "</worldbody>\n<actuator>\n" + motors(arm, options) + "</actuator>\n</mujoco>\n";
}

} // namespace castor::manipulation
