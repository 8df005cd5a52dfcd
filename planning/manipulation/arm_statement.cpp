#include "castor/planning/manipulation/arm_statement.hpp"

#include "castor/base/text_file.hpp"
#include "castor/mapping/geometry/poses.hpp"

#include <cmath>
#include <numbers>

namespace castor::manipulation {

namespace {

// What is taken for a slip of the pen beyond these.
constexpr double farthest = 10;         // m
constexpr double largest_shape = 5;     // m
constexpr double smallest_shape = 1e-3; // m
constexpr double most_degrees = 7200;
constexpr double most_slide_speed = 20; // m/s, m/s^2

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

void expect(StatementWords& words, const std::string& word, const std::string& example) {
  if (words.accept(word))
    return;
  if (words.at_end())
    throw StatementError("the line ends where \"" + word + "\" should be",
                         "Continue it, for example: " + example);
  throw StatementError("\"" + words.peek() + "\" stands where \"" + word + "\" should be",
                       "Write, for example: " + example);
}

Point3 read_point(StatementWords& words, const std::string& of_what) {
  Point3 result;
  result.x = words.length("the x of " + of_what, -farthest, farthest);
  result.y = words.length("the y of " + of_what, -farthest, farthest);
  result.z = words.length("the z of " + of_what, -farthest, farthest);
  return result;
}

geometry::Rotation read_turn(StatementWords& words) {
  if (!words.accept("turned"))
    return {};
  const double roll = words.number("the roll", -360, 360);
  const double pitch = words.number("the pitch", -360, 360);
  const double yaw = words.number("the yaw", -360, 360);
  return roll_pitch_yaw(radians(roll), radians(pitch), radians(yaw));
}

Point3 read_axis(StatementWords& words) {
  expect(words, "axis", "axis z");
  for (const auto& [name, axis] : {std::pair{"x", Point3{1, 0, 0}}, std::pair{"y", Point3{0, 1, 0}},
                                   std::pair{"z", Point3{0, 0, 1}}})
    if (words.accept(name))
      return axis;
  Point3 axis;
  axis.x = words.number("the x of the axis", -1, 1);
  axis.y = words.number("the y of the axis", -1, 1);
  axis.z = words.number("the z of the axis", -1, 1);
  const double length = std::hypot(axis.x, axis.y, axis.z);
  if (length < 1e-6)
    throw StatementError("the axis has no direction",
                         "Write x, y or z, or three numbers that are not all 0.");
  return {axis.x / length, axis.y / length, axis.z / length};
}

/// An angle in radians, or of a slide a length.
double read_travel(StatementWords& words, JointKind kind, const std::string& what) {
  return kind == JointKind::sliding ? words.length(what, -farthest, farthest)
                                    : radians(words.number(what, -720, 720));
}

double read_rate(StatementWords& words, JointKind kind, const std::string& what) {
  const bool slides = kind == JointKind::sliding;
  const double value = words.number("the " + what, 0, slides ? most_slide_speed : most_degrees);
  if (value == 0)
    throw StatementError("the " + what + " of a joint that moves is 0",
                         "Write what it is, or \"fixed\" for a joint that does not move.");
  return slides ? value : radians(value);
}

void read_limits(StatementWords& words, Joint& joint) {
  const std::string example =
    joint.kind == JointKind::sliding
      ? "slide lift moves carriage at 0 0 0.1 axis z from 0 to 0.4 speed 0.2 acceleration 0.5"
      : "joint elbow moves forearm at 0 0 0.19 axis y from -120 to 120 speed 70 acceleration 120";
  joint.axis = read_axis(words);
  expect(words, "from", example);
  joint.lower = read_travel(words, joint.kind, "the lower limit");
  expect(words, "to", example);
  joint.upper = read_travel(words, joint.kind, "the upper limit");
  if (joint.lower >= joint.upper)
    throw StatementError(
      "the lower limit of " + joint.name + " is not below the upper one",
      "Write the lower one first, and \"fixed\" for a joint that does not move.");
  expect(words, "speed", example);
  joint.speed = read_rate(words, joint.kind, "speed");
  expect(words, "acceleration", example);
  joint.acceleration = read_rate(words, joint.kind, "acceleration");
}

Solid read_solid(StatementWords& words) {
  const std::string kind = words.next("the kind of shape");
  auto take = [&](const std::string& what) {
    return words.length("the " + what, smallest_shape, largest_shape);
  };
  // Arguments of a function would be read in any order.
  if (kind == "box") {
    const double x = take("length");
    const double y = take("width");
    return box(x, y, take("height"));
  }
  if (kind == "cylinder") {
    const double diameter = take("diameter");
    return cylinder(diameter, take("height"));
  }
  if (kind == "sphere")
    return sphere(take("diameter"));
  if (kind != "capsule")
    throw StatementError(
      "\"" + kind + "\" is no shape",
      remedy_for(kind, std::vector<std::string>{"box", "cylinder", "capsule", "sphere"}, "shapes"));
  const double diameter = take("diameter");
  const double length = take("length");
  if (length < diameter)
    throw StatementError("the capsule is shorter than its diameter",
                         "Its length includes both round ends: write at least " +
                           readable(diameter) + ", or make it a sphere.");
  return capsule(diameter, length);
}

} // namespace

const std::vector<std::string>& arm_keywords() {
  static const std::vector<std::string> keywords{"arm",   "base", "joint",   "slide", "fixed",
                                                 "shape", "tool", "gripper", "home"};
  return keywords;
}

std::pair<Joint, Link> read_joint(StatementWords& words, JointKind kind) {
  Joint joint;
  joint.name = words.name("the joint's name");
  joint.kind = kind;
  const bool moves = kind != JointKind::fixed;
  expect(words, moves ? "moves" : "carries",
         moves ? "joint elbow moves forearm at 0 0 0.19 ..."
               : "fixed wrist carries hand at 0 0 0.1");
  Link link{words.name("the link's name"), {}};
  joint.origin = read_arm_pose(words, "the joint");
  if (moves)
    read_limits(words, joint);
  return {joint, link};
}

PlacedSolid read_shape(StatementWords& words) {
  PlacedSolid result;
  result.solid = read_solid(words);
  if (words.accept("at"))
    result.pose.position = read_point(words, "the shape");
  result.pose.rotation = read_turn(words);
  return result;
}

Pose read_arm_pose(StatementWords& words, const std::string& of_what) {
  expect(words, "at", "at 0 0 0.19");
  Pose result;
  result.position = read_point(words, of_what);
  result.rotation = read_turn(words);
  return result;
}

Gripper read_gripper(StatementWords& words) {
  const std::string example =
    "gripper opens 0 to 0.1 speed 0.1 fingers 0.02 0.012 0.07 beyond 0.01";
  Gripper result;
  expect(words, "opens", example);
  result.narrowest = words.length("the least opening", 0, largest_shape);
  expect(words, "to", example);
  result.widest = words.length("the largest opening", smallest_shape, largest_shape);
  if (result.narrowest >= result.widest)
    throw StatementError("the least opening of the gripper is not below the largest",
                         "Write the least one first, for example: " + example);
  expect(words, "speed", example);
  result.speed = words.number("the gripper's speed", smallest_shape, most_slide_speed);
  expect(words, "fingers", example);
  result.finger.x = words.length("the width of a finger", smallest_shape, largest_shape);
  result.finger.y = words.length("the thickness of a finger", smallest_shape, largest_shape);
  result.finger.z = words.length("the length of a finger", smallest_shape, largest_shape);
  expect(words, "beyond", example);
  result.beyond = words.length("what fingers reach beyond the tool", 0, result.finger.z);
  return result;
}

Configuration read_home(StatementWords& words, const ArmModel& arm) {
  Configuration result;
  for (auto index : moving_joints(arm)) {
    const auto& joint = arm.joints[index];
    const double value = read_travel(words, joint.kind, "the position of " + joint.name);
    if (value < joint.lower || value > joint.upper) {
      const double unit = joint.kind == JointKind::sliding ? 1 : radians(1);
      throw StatementError("the position of " + joint.name + " is beyond its limits",
                           "It can be from " + readable(joint.lower / unit) + " to " +
                             readable(joint.upper / unit) + ".");
    }
    result.push_back(value);
  }
  return result;
}

geometry::Rotation roll_pitch_yaw(double roll, double pitch, double yaw) {
  const geometry::Rotation about_x{std::cos(roll / 2), std::sin(roll / 2), 0, 0};
  const geometry::Rotation about_y{std::cos(pitch / 2), 0, std::sin(pitch / 2), 0};
  return geometry::compose(geometry::rotation_about_z(yaw), geometry::compose(about_y, about_x));
}

} // namespace castor::manipulation
