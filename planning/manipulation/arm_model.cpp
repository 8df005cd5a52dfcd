#include "castor/planning/manipulation/arm_model.hpp"

#include "castor/mapping/geometry/poses.hpp"

#include <algorithm>
#include <cmath>

namespace castor::manipulation {

namespace {

double length(const Point3& vector) {
  return std::hypot(vector.x, vector.y, vector.z);
}

/// How far a slide is from 0 at most.
double travel(const Joint& joint) {
  return joint.kind == JointKind::sliding ? std::max(std::abs(joint.lower), std::abs(joint.upper))
                                          : 0;
}

/// Distance of the farthest point of a link from its origin.
double outer_radius(const Link& link) {
  double result = 0;
  for (const auto& shape : link.shapes)
    result = std::max(result, length(shape.pose.position) + outer_radius(shape.solid));
  return result;
}

} // namespace

std::vector<std::size_t> moving_joints(const ArmModel& arm) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < arm.joints.size(); ++i)
    if (arm.joints[i].kind != JointKind::fixed)
      result.push_back(i);
  return result;
}

bool within_limits(const ArmModel& arm, std::span<const double> configuration, double tolerance) {
  const auto moving = moving_joints(arm);
  if (configuration.size() != moving.size())
    return false;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const auto& joint = arm.joints[moving[i]];
    if (!(configuration[i] >= joint.lower - tolerance &&
          configuration[i] <= joint.upper + tolerance))
      return false;
  }
  return true;
}

bool stands_still(const Joint& joint) {
  return joint.kind != JointKind::fixed && joint.lower == joint.upper;
}

ArmModel with_still_joint(ArmModel arm, std::size_t index, double at) {
  auto& joint = arm.joints[moving_joints(arm).at(index)];
  joint.lower = joint.upper = at;
  return arm;
}

Configuration kept_within_limits(const ArmModel& arm, Configuration configuration) {
  const auto moving = moving_joints(arm);
  for (std::size_t i = 0; i < std::min(moving.size(), configuration.size()); ++i) {
    const auto& joint = arm.joints[moving[i]];
    configuration[i] = std::clamp(configuration[i], joint.lower, joint.upper);
  }
  return configuration;
}

double reach(const ArmModel& arm) {
  const auto moving = moving_joints(arm);
  double result = length(arm.tool.position);
  for (std::size_t i = arm.joints.size(); i-- > 0;) {
    const auto& joint = arm.joints[i];
    result += travel(joint);
    if (!moving.empty() && i == moving.front())
      break;
    result += length(joint.origin.position);
  }
  return result;
}

std::vector<double> lever_arms(const ArmModel& arm, double beyond_tool) {
  const double tool = length(arm.tool.position);
  double farthest = tool + beyond_tool;
  if (const auto& gripper = arm.gripper) {
    const double inner = gripper->finger.z - gripper->beyond;
    const double along = std::max(std::abs(inner), gripper->beyond);
    farthest = std::max(farthest, tool + std::hypot(along, gripper->finger.x / 2,
                                                    gripper->widest / 2 + gripper->finger.y));
  }
  std::vector<double> result;
  for (std::size_t i = arm.joints.size(); i-- > 0;) {
    const auto& joint = arm.joints[i];
    farthest = std::max(farthest, outer_radius(arm.links[i + 1]));
    if (joint.kind != JointKind::fixed)
      result.push_back(joint.kind == JointKind::turning ? farthest : 1);
    farthest += length(joint.origin.position) + travel(joint);
  }
  std::ranges::reverse(result);
  return result;
}

std::vector<PlacedSolid> fingers(const ArmModel& arm, double opening) {
  if (!arm.gripper)
    return {};
  const auto& size = arm.gripper->finger;
  const double y = (opening + size.y) / 2;
  const double z = arm.gripper->beyond - size.z / 2;
  const auto finger = box(size.x, size.y, size.z);
  return {{finger, {{0, y, z}, {}, {}}}, {finger, {{0, -y, z}, {}, {}}}};
}

Solid gap_between_fingers(const Gripper& gripper, double opening) {
  return box(gripper.finger.x / 2, std::max(opening, 1e-6), 2 * gripper.beyond);
}

} // namespace castor::manipulation
