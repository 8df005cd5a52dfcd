#include "castor/planning/manipulation/kinematics.hpp"

#include "castor/planning/manipulation/kinematic_chain.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace castor::manipulation {

namespace {

void move(Eigen::Isometry3d& pose, JointKind kind, const Eigen::Vector3d& axis, double position) {
  if (kind == JointKind::turning)
    pose.rotate(Eigen::AngleAxisd(position, axis));
  else
    pose.translate(position * axis);
}

} // namespace

KinematicChain::KinematicChain(const ArmModel& arm) : tool_(to_isometry(arm.tool)) {
  for (const auto& joint : arm.joints) {
    segments_.push_back({joint.kind, to_isometry(joint.origin), geometry::to_eigen(joint.axis)});
    size_ += joint.kind != JointKind::fixed;
  }
}

void KinematicChain::check(std::span<const double> configuration) const {
  if (configuration.size() != size_)
    throw std::invalid_argument("a configuration has " + std::to_string(configuration.size()) +
                                " numbers, but " + std::to_string(size_) +
                                " joints of the arm move");
}

void KinematicChain::link_poses(std::span<const double> configuration,
                                std::vector<Eigen::Isometry3d>& result) const {
  check(configuration);
  result.resize(segments_.size() + 1);
  result[0].setIdentity();
  const double* position = configuration.data();
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const auto& [kind, origin, axis] = segments_[i];
    result[i + 1] = result[i] * origin;
    if (kind != JointKind::fixed)
      move(result[i + 1], kind, axis, *position++);
  }
}

Eigen::Isometry3d KinematicChain::tool(std::span<const double> configuration) const {
  check(configuration);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  const double* position = configuration.data();
  for (const auto& [kind, origin, axis] : segments_) {
    result = result * origin;
    if (kind != JointKind::fixed)
      move(result, kind, axis, *position++);
  }
  return result * tool_;
}

Eigen::Isometry3d KinematicChain::tool(std::span<const double> configuration,
                                       Jacobian& jacobian) const {
  std::vector<Eigen::Isometry3d> poses;
  link_poses(configuration, poses);
  const Eigen::Isometry3d result = poses.back() * tool_;
  jacobian.resize(6, static_cast<Eigen::Index>(size_));
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    if (segments_[i].kind == JointKind::fixed)
      continue;
    // A joint does not move its own axis.
    const Eigen::Vector3d axis = poses[i + 1].linear() * segments_[i].axis;
    const Eigen::Vector3d to_tool = result.translation() - poses[i + 1].translation();
    const bool turns = segments_[i].kind == JointKind::turning;
    jacobian.col(column).head<3>() = turns ? Eigen::Vector3d(axis.cross(to_tool)) : axis;
    jacobian.col(column).tail<3>() = turns ? axis : Eigen::Vector3d::Zero();
    ++column;
  }
  return result;
}

Pose tool_pose(const ArmModel& arm, std::span<const double> configuration) {
  return to_pose(KinematicChain(arm).tool(configuration));
}

std::vector<Pose> link_poses(const ArmModel& arm, std::span<const double> configuration) {
  std::vector<Eigen::Isometry3d> poses;
  KinematicChain(arm).link_poses(configuration, poses);
  std::vector<Pose> result;
  for (const auto& pose : poses)
    result.push_back(to_pose(pose));
  return result;
}

double distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

} // namespace castor::manipulation
