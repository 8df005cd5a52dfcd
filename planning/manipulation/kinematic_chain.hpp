#pragma once

#include "castor/mapping/geometry/eigen_bridge.hpp"
#include "castor/planning/manipulation/arm_model.hpp"

#include <span>
#include <vector>

namespace castor::manipulation {

inline Eigen::Isometry3d to_isometry(const Pose& pose) {
  Eigen::Isometry3d result(geometry::to_eigen(pose.rotation).normalized());
  result.pretranslate(geometry::to_eigen(pose.position));
  return result;
}

inline Pose to_pose(const Eigen::Isometry3d& transform) {
  return {geometry::to_point(transform.translation()),
          geometry::to_rotation(Eigen::Quaterniond(transform.rotation())), arm_frame};
}

/// The joints of an arm in the form that Eigen calculates with. For source files and private
/// headers only.
class KinematicChain {
public:
  using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

  explicit KinematicChain(const ArmModel& arm);

  /// How many joints move.
  std::size_t size() const { return size_; }

  /// \throws std::invalid_argument if there is not one number for each joint that moves.
  void check(std::span<const double> configuration) const;

  /// Poses of all links in the arm's frame, the base first.
  /// Throws as `check` does.
  void link_poses(std::span<const double> configuration,
                  std::vector<Eigen::Isometry3d>& result) const;

  /// Pose of the tool. Throws as `check` does.
  Eigen::Isometry3d tool(std::span<const double> configuration) const;

  /// The tool's pose on the last link.
  const Eigen::Isometry3d& tool_on_link() const { return tool_; }

  /// Pose of the tool, and in the columns of `jacobian` its velocity, in the first three rows, and
  /// its angular velocity in the arm's frame, for each joint that moves at 1.
  Eigen::Isometry3d tool(std::span<const double> configuration, Jacobian& jacobian) const;

private:
  struct Segment {
    JointKind kind;
    Eigen::Isometry3d origin;
    Eigen::Vector3d axis;
  };

  std::vector<Segment> segments_;
  Eigen::Isometry3d tool_;
  std::size_t size_ = 0;
};

} // namespace castor::manipulation
