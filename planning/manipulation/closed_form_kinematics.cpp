#include "castor/planning/manipulation/closed_form_kinematics.hpp"

#include "castor/planning/manipulation/kinematic_chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace castor::manipulation {

namespace {

using std::numbers::pi;

// Beyond rounding errors of files that people write.
constexpr double is_zero = 1e-9;
// The tool's z axis may be that far from the arm's plane.
constexpr double angle_tolerance = 1e-7;
// Radians that the tool may be turned about its own axis by a roll that stands still.
constexpr double still_roll_tolerance = 5 * pi / 180;

bool is_along_z(const Pose& pose) {
  return std::abs(pose.position.x) < is_zero && std::abs(pose.position.y) < is_zero;
}

bool is_turned_about_z(const geometry::Rotation& rotation) {
  return std::abs(rotation.x) < is_zero && std::abs(rotation.y) < is_zero;
}

bool is_turned(const geometry::Rotation& rotation) {
  return !is_turned_about_z(rotation) || std::abs(rotation.z) > is_zero;
}

/// Direction of the vertical plane that the arm moves in, radians. It has the target in it, and the
/// tool's direction, if the arm can turn the tool so: added up, they have a direction where one of
/// them is too short to have one.
double azimuth_of_plane(const Eigen::Vector2d& position, const Eigen::Vector2d& approach) {
  const double area = position.x() * approach.y() - position.y() * approach.x();
  const double distance = position.norm();
  const bool disagree = distance > 1e-6 && std::abs(area) > angle_tolerance * distance;
  Eigen::Vector2d result = position;
  if (!disagree)
    result += position.dot(approach) < 0 ? Eigen::Vector2d(-approach) : approach;
  return std::atan2(result.y(), result.x());
}

/// The same angle within the limits, or the one that is nearest to their middle.
double turned_into(double angle, double lower, double upper) {
  const double middle = (lower + upper) / 2;
  return middle + std::remainder(angle - middle, 2 * pi);
}

} // namespace

std::optional<ClosedFormKinematics> ClosedFormKinematics::of(const ArmModel& arm) {
  constexpr std::array<double, 5> about_z{1, 0, 0, 0, 1};
  ClosedFormKinematics result;
  std::array<double, 6> lengths{};
  std::size_t index = 0;
  for (const auto& joint : arm.joints) {
    if (!is_along_z(joint.origin) || is_turned(joint.origin.rotation))
      return {};
    lengths[index] += joint.origin.position.z;
    if (joint.kind == JointKind::fixed)
      continue;
    if (joint.kind != JointKind::turning || index == about_z.size())
      return {};
    const double along = about_z[index] > 0 ? joint.axis.z : joint.axis.y;
    if (std::abs(std::abs(along) - 1) > is_zero)
      return {};
    result.joints_[index] = {joint.lower, joint.upper, along > 0 ? 1.0 : -1.0};
    ++index;
  }
  if (index != about_z.size() || !is_along_z(arm.tool) || !is_turned_about_z(arm.tool.rotation))
    return {};
  lengths[5] += arm.tool.position.z;
  result.shoulder_ = lengths[0] + lengths[1];
  result.upper_arm_ = lengths[2];
  result.forearm_ = lengths[3];
  result.hand_ = lengths[4] + lengths[5];
  if (result.upper_arm_ < is_zero || result.forearm_ < is_zero)
    return {};
  result.tool_turn_ = 2 * std::atan2(arm.tool.rotation.z, arm.tool.rotation.w);
  return result;
}

std::vector<ClosedFormKinematics::Candidate>
ClosedFormKinematics::candidates(const Pose& tool) const {
  const Eigen::Vector3d approach =
    geometry::to_eigen(tool.rotation).normalized() * Eigen::Vector3d::UnitZ();
  const double tilt = std::atan2(approach.head<2>().norm(), approach.z());
  const Eigen::Vector2d position(tool.position.x, tool.position.y);
  const double toward = azimuth_of_plane(position, approach.head<2>());
  std::vector<Candidate> result;
  for (const double azimuth : {toward, toward + pi})
    for (const double pitch : {tilt, -tilt}) {
      // Of the third pitch joint, from the first.
      const double r = position.x() * std::cos(azimuth) + position.y() * std::sin(azimuth) -
                       hand_ * std::sin(pitch);
      const double z = tool.position.z - shoulder_ - hand_ * std::cos(pitch);
      const double cosine = (r * r + z * z - upper_arm_ * upper_arm_ - forearm_ * forearm_) /
                            (2 * upper_arm_ * forearm_);
      if (!(std::abs(cosine) <= 1 + 1e-12))
        continue;
      const double bend = std::acos(std::clamp(cosine, -1.0, 1.0));
      for (const double elbow : {bend, -bend}) {
        const double lift = std::atan2(r, z) - std::atan2(forearm_ * std::sin(elbow),
                                                          upper_arm_ + forearm_ * std::cos(elbow));
        result.push_back(candidate(tool, azimuth, lift, elbow, pitch));
      }
    }
  return result;
}

ClosedFormKinematics::Candidate ClosedFormKinematics::candidate(const Pose& tool, double azimuth,
                                                                double lift, double bend,
                                                                double pitch) const {
  const Eigen::Matrix3d before = (Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()))
                                   .toRotationMatrix();
  const Eigen::Matrix3d roll =
    before.transpose() * geometry::to_eigen(tool.rotation).normalized().toRotationMatrix();
  const std::array<double, 5> angles{azimuth, lift, bend, pitch - lift - bend,
                                     std::atan2(roll(1, 0), roll(0, 0)) - tool_turn_};
  Candidate result;
  result.has_rotation = roll(2, 2) > 0 && std::hypot(roll(0, 2), roll(1, 2)) < angle_tolerance;
  result.is_within_limits = true;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto& [lower, upper, sign] = joints_[i];
    double angle = turned_into(sign * angles[i], lower, upper);
    const bool is_still_roll = i + 1 == angles.size() && lower == upper;
    const double tolerance = is_still_roll ? still_roll_tolerance : is_zero;
    if (angle < lower - tolerance || angle > upper + tolerance)
      result.is_within_limits = false;
    else
      angle = std::clamp(angle, lower, upper);
    result.configuration.push_back(angle);
  }
  return result;
}

} // namespace castor::manipulation
