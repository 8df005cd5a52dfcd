#pragma once

#include "castor/mapping/body/components/drives.hpp"
#include "castor/mapping/planar/corrected_pose.hpp"
#include "castor/mapping/slam/types.hpp"

#include <optional>
#include <string>

namespace castor::mapping {

/// By what a driver knows where the robot is; the truth is for tests.
enum class PoseSource { odometry, localisation, truth };
CASTOR_REFLECT_ENUM(PoseSource, odometry, localisation, truth)

/// A component that drives and knows where the robot is, by --pose.
class DrivesByPose : public Drives {
protected:
  /// @param source default of --pose
  explicit DrivesByPose(PoseSource source)
    : pose_source_{this, "pose", source, "by what it knows where the robot is"} {
    // nop
  }

  /// To be called in `start()`.
  void follow_pose() {
    switch (pose_source_) {
      case PoseSource::odometry:
        on_push<Odometry>(sensors(), [this](auto& x) { pose_ = x->pose; });
        break;
      case PoseSource::truth:
        on_push<BodyStatus>(sensors(), [this](auto& x) { pose_ = x->pose; });
        break;
      case PoseSource::localisation:
        on_push<Odometry>(sensors(), [this](auto& x) {
          corrected_.add(*x);
          pose_ = corrected_.now();
        });
        on_change(changed<RobotPose>().in(localisation_),
                  [this](const ChangeEvent& event) { look_at_pose(event.address); });
        // It is not told again while the robot stands.
        for (auto& x : read_all_in<RobotPose>(localisation_.get()))
          take_pose(*x);
        break;
    }
  }

  /// Nothing as long as it is not known.
  const std::optional<Pose2>& pose() const { return pose_; }

  /// Why the pose does not count at present; empty if it does.
  const std::string& lost_reason() const { return lost_reason_; }
  bool is_lost() const { return !lost_reason_.empty(); }

private:
  void look_at_pose(const Address& address) {
    try {
      take_pose(*read<RobotPose>(address));
    } catch (const DoesNotExistOnWM&) {
      lost_reason_ = "nobody says where the robot is";
    }
  }

  void take_pose(const RobotPose& x) {
    lost_reason_.clear();
    if (x.state == LocalisationState::lost)
      lost_reason_ = x.reason.empty() ? "the robot is lost" : x.reason;
    else if (x.state != LocalisationState::starting)
      corrected_.correct(x.time, x.pose);
  }

  Option<PoseSource> pose_source_;
  Option<SubarchitectureName> localisation_{
    this, "localisation", "slam", "whose RobotPose entries count with --pose localisation"};

  CorrectedPose corrected_;
  std::optional<Pose2> pose_;
  std::string lost_reason_;
};

} // namespace castor::mapping
