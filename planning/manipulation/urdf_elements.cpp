#include "castor/planning/manipulation/urdf_elements.hpp"

#include "castor/base/text_file.hpp"
#include "castor/planning/manipulation/arm_statement.hpp"

#include <tinyxml2.h>

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace castor::manipulation {

namespace {

using tinyxml2::XMLElement;

std::string tag(const XMLElement& element) {
  return "<" + std::string(element.Name()) + ">";
}

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  if (!value || !*value)
    throw UrdfError(element, tag(element) + " has no attribute \"" + name + "\"",
                    "Add " + std::string(name) + "=\"...\".");
  return value;
}

const XMLElement& child(const XMLElement& element, const char* name) {
  if (const auto* result = element.FirstChildElement(name))
    return *result;
  throw UrdfError(element, tag(element) + " has no <" + name + ">",
                  "Add it: " + tag(element) + " of this kind needs one.");
}

double number(const XMLElement& element, const std::string& word) {
  const auto value = parse_number(word);
  if (!value)
    throw UrdfError(
      element, "\"" + word + "\" in " + tag(element) + " is no number",
      "Write a number with a decimal point. Files of xacro have to be expanded: xacro "
      "FILE > FILE.urdf");
  return *value;
}

/// A number above 0.
double extent(const XMLElement& element, const char* name) {
  const std::string word = attribute(element, name);
  const double value = number(element, word);
  if (value <= 0)
    throw UrdfError(element, "the " + std::string(name) + " of " + tag(element) + " is " + word,
                    "It has to be more than 0.");
  return value;
}

Point3 three_numbers(const XMLElement& element, const char* name, const Point3& otherwise) {
  const char* text = element.Attribute(name);
  if (!text)
    return otherwise;
  std::istringstream words{text};
  std::array<double, 3> result{};
  std::string word;
  for (auto& x : result) {
    if (!(words >> word))
      throw UrdfError(element,
                      "\"" + std::string(name) + "\" of " + tag(element) +
                        " has fewer than three numbers",
                      "Write three, for example: " + std::string(name) + "=\"0 0 0.1\"");
    x = number(element, word);
  }
  if (words >> word)
    throw UrdfError(
      element, "\"" + std::string(name) + "\" of " + tag(element) + " has more than three numbers",
      "Remove \"" + word + "\".");
  return {result[0], result[1], result[2]};
}

Pose read_origin(const XMLElement& parent) {
  const auto* element = parent.FirstChildElement("origin");
  if (!element)
    return {};
  const auto rpy = three_numbers(*element, "rpy", {});
  return {three_numbers(*element, "xyz", {}), roll_pitch_yaw(rpy.x, rpy.y, rpy.z), {}};
}

Solid read_box(const XMLElement& element) {
  attribute(element, "size");
  const auto size = three_numbers(element, "size", {});
  if (size.x <= 0 || size.y <= 0 || size.z <= 0)
    throw UrdfError(element, "a length of the box is not more than 0", "Write its size in metres.");
  return box(size.x, size.y, size.z);
}

void read_shape(const XMLElement& collision, UrdfLink& link) {
  const auto& geometry = child(collision, "geometry");
  PlacedSolid shape{{}, read_origin(collision)};
  if (const auto* element = geometry.FirstChildElement("box"))
    shape.solid = read_box(*element);
  else if (const auto* round = geometry.FirstChildElement("cylinder"))
    shape.solid = cylinder(2 * extent(*round, "radius"), extent(*round, "length"));
  else if (const auto* ball = geometry.FirstChildElement("sphere"))
    shape.solid = sphere(2 * extent(*ball, "radius"));
  else if (const auto* mesh = geometry.FirstChildElement("mesh")) {
    link.meshes.push_back(mesh->GetLineNum());
    return;
  } else
    throw UrdfError(geometry, "<geometry> has no shape that is known",
                    "The shapes are: box, cylinder, sphere, mesh.");
  link.link.shapes.push_back(shape);
}

Point3 read_axis(const XMLElement& element) {
  const auto* axis = element.FirstChildElement("axis");
  if (!axis)
    return {1, 0, 0};
  attribute(*axis, "xyz");
  const auto xyz = three_numbers(*axis, "xyz", {});
  const double length = std::hypot(xyz.x, xyz.y, xyz.z);
  if (length < 1e-6)
    throw UrdfError(*axis, "the axis has no direction", "Write, for example: xyz=\"0 0 1\"");
  return {xyz.x / length, xyz.y / length, xyz.z / length};
}

void read_limits(const XMLElement& element, bool is_endless, Joint& joint) {
  const auto& limit = child(element, "limit");
  joint.speed = extent(limit, "velocity");
  if (is_endless) {
    joint.lower = -std::numbers::pi;
    joint.upper = std::numbers::pi;
    return;
  }
  joint.lower = number(limit, limit.Attribute("lower") ? attribute(limit, "lower") : "0");
  joint.upper = number(limit, limit.Attribute("upper") ? attribute(limit, "upper") : "0");
  if (joint.lower >= joint.upper)
    throw UrdfError(limit, "the lower limit of " + joint.name + " is not below the upper one",
                    "Write both, or make the joint a fixed one.");
}

} // namespace

UrdfError::UrdfError(const tinyxml2::XMLElement& element, const std::string& message,
                     std::string remedy)
  : std::runtime_error(message), line_(element.GetLineNum()), remedy_(std::move(remedy)) {
  // nop
}

UrdfJoint read_urdf_joint(const tinyxml2::XMLElement& element) {
  UrdfJoint result;
  auto& joint = result.joint;
  result.line = element.GetLineNum();
  joint.name = attribute(element, "name");
  result.parent = attribute(child(element, "parent"), "link");
  result.child = attribute(child(element, "child"), "link");
  joint.origin = read_origin(element);
  const std::string kind = attribute(element, "type");
  if (kind == "fixed") {
    joint.kind = JointKind::fixed;
    return result;
  }
  if (kind != "revolute" && kind != "continuous" && kind != "prismatic")
    throw UrdfError(element, "joint " + joint.name + " is of the type \"" + kind + "\"",
                    "The types that arms have are: revolute, continuous, prismatic, fixed.");
  joint.kind = kind == "prismatic" ? JointKind::sliding : JointKind::turning;
  joint.axis = read_axis(element);
  read_limits(element, kind == "continuous", joint);
  return result;
}

UrdfLink read_urdf_link(const tinyxml2::XMLElement& element) {
  UrdfLink result;
  result.line = element.GetLineNum();
  result.link.name = attribute(element, "name");
  for (const auto* x = element.FirstChildElement("collision"); x;
       x = x->NextSiblingElement("collision"))
    read_shape(*x, result);
  return result;
}

} // namespace castor::manipulation
