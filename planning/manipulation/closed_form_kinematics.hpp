#pragma once

#include "castor/planning/manipulation/arm_model.hpp"

#include <array>
#include <optional>
#include <vector>

namespace castor::manipulation {

/// Inverse kinematics in closed form of arms like the Katana: a turret (about z), three pitch
/// joints (about y), and a roll of the hand (about z), all in one line while they are at 0. Such an
/// arm reaches a position with any tilt of the tool, but not with any heading: the tool's z axis
/// lies in the vertical plane through the base.
class ClosedFormKinematics {
public:
  /// Nothing for an arm of another geometry.
  static std::optional<ClosedFormKinematics> of(const ArmModel& arm);

  struct Candidate {
    /// Within (-pi, pi], or turned by whole turns into the limits where that is possible.
    Configuration configuration;
    bool is_within_limits = false;
    /// Whether the tool is turned as asked; otherwise only its position and its tilt are right.
    /// With a roll that stands still, it may be turned about its own axis by up to 5 degrees.
    bool has_rotation = false;
  };

  /// All candidates for a pose of the tool in the arm's frame: turret to or from the target, tool
  /// tilted outwards or inwards, elbow up or down. Eight of them, four where only one tilt is near
  /// enough, none where the target is out of reach.
  std::vector<Candidate> candidates(const Pose& tool) const;

private:
  struct Limits {
    double lower = 0;
    double upper = 0;
    /// Of the joint's axis: 1 or -1.
    double sign = 1;
  };

  ClosedFormKinematics() = default;

  /// Joints, without regard to limits: azimuth of the arm's plane, directions of its links in it.
  Candidate candidate(const Pose& tool, double azimuth, double lift, double bend,
                      double pitch) const;

  std::array<Limits, 5> joints_;
  /// Height of the first pitch joint, metres.
  double shoulder_ = 0;
  /// From the first pitch joint to the second and to the third, and from there to the tool, metres.
  double upper_arm_ = 0;
  double forearm_ = 0;
  double hand_ = 0;
  /// Angle of the tool's frame on the last link.
  double tool_turn_ = 0;
};

} // namespace castor::manipulation
