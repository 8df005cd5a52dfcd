#include "castor/planning/manipulation/grasp_candidates.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/kinematic_chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace castor::manipulation {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

// Surfaces are parallel to the fingers if they are by less than this, the sine of 10 degrees.
constexpr double nearly_right_angle = 0.17;
// Fingers that reach less deep below the top of a thing slip off, metres.
constexpr double least_overlap = 0.005;
// What is round slips out if it touches a finger nearer to its edge, metres.
constexpr double rim = 0.002;
// Ways to turn the fingers around what is round, for an arm that cannot turn them: it has to be one
// of theirs by chance.
constexpr int still_turns = 18;

double half_extent(const NamedSolid& thing, const Vector3d& direction) {
  return manipulation::half_extent(thing, geometry::to_point(direction));
}

/// From the thing's middle against the direction, however high it may be.
double most_extent(const NamedSolid& thing, const Vector3d& direction) {
  const Vector3d axis = geometry::to_eigen(thing.pose.rotation).toRotationMatrix().col(2);
  return half_extent(thing, direction) + thing.higher * std::max(0.0, -axis.dot(direction));
}

struct Closing {
  Vector3d direction;
  double width;
};

/// Directions at right angles to the approach, evenly over half a turn.
std::vector<Closing> all_around(const Vector3d& approach, double width, int count) {
  const Vector3d first = approach.unitOrthogonal();
  std::vector<Closing> result;
  for (int i = 0; i < count; ++i)
    result.push_back({Eigen::AngleAxisd(pi * i / count, approach) * first, width});
  return result;
}

/// The part of an axis that is at right angles to the approach, if most of it is.
std::optional<Vector3d> across(const Vector3d& axis, const Vector3d& approach) {
  if (std::abs(axis.dot(approach)) > nearly_right_angle)
    return {};
  return (axis - axis.dot(approach) * approach).normalized();
}

/// Directions in which fingers can close on the thing.
std::vector<Closing> closings(const NamedSolid& thing, const Vector3d& approach, int turns) {
  const auto& size = thing.solid.size;
  const Eigen::Matrix3d axes = geometry::to_eigen(thing.pose.rotation).toRotationMatrix();
  std::vector<Closing> result;
  if (thing.solid.kind == SolidKind::sphere)
    return all_around(approach, size.x, turns);
  if (thing.solid.kind == SolidKind::box) {
    const std::array<double, 3> sizes{size.x, size.y, size.z};
    for (int i = 0; i < 3; ++i)
      if (const auto direction = across(axes.col(i), approach))
        result.push_back({*direction, sizes[static_cast<std::size_t>(i)]});
    return result;
  }
  const Vector3d axis = axes.col(2);
  if (axis.cross(approach).norm() < nearly_right_angle)
    return all_around(approach, size.x, turns);
  result.push_back({axis.cross(approach).normalized(), size.x});
  if (const auto along = across(axis, approach))
    result.push_back({*along, size.z});
  return result;
}

class Candidates {
public:
  Candidates(const ArmModel& arm, const NamedSolid& thing, const GraspOptions& options)
    : gripper_(*arm.gripper), thing_(thing), options_(options),
      turns_(std::ranges::any_of(arm.joints, stands_still) ? std::max(options.turns, still_turns)
                                                           : options.turns),
      position_(geometry::to_eigen(thing.pose.position)) {
    // nop
  }

  std::vector<GraspCandidate> all(bool follows_turret) {
    const double turret = std::atan2(position_.y(), position_.x());
    for (double tilt : options_.tilts) {
      const bool is_from_above = std::abs(std::sin(tilt)) < 1e-9;
      const int azimuths = follows_turret || is_from_above ? 1 : options_.azimuths;
      for (int i = 0; i < azimuths; ++i)
        add_from(tilt, turret + 2 * pi * i / azimuths);
    }
    return std::move(result_);
  }

private:
  void add_from(double tilt, double azimuth) {
    const double across = std::abs(std::sin(tilt)) < 1e-9 ? 0 : std::sin(tilt);
    const Vector3d approach(across * std::cos(azimuth), across * std::sin(azimuth),
                            across == 0 ? -1 : std::cos(tilt));
    for (const auto& [direction, width] : closings(thing_, approach, turns_)) {
      if (width + options_.spare > gripper_.widest || width < gripper_.narrowest)
        continue;
      const auto at = position_for(approach, direction);
      // Fingers are alike: half a turn of the hand is another way to the same grasp.
      for (const double sign : {1.0, -1.0})
        if (at)
          add(*at, approach, sign * direction, tilt, width);
    }
  }

  /// Where the tool's origin is: in the thing's middle, if the fingers reach so deep, and what it
  /// stands on is not in their way.
  std::optional<Vector3d> position_for(const Vector3d& approach, const Vector3d& closing) const {
    const double depth = gripper_.finger.z - gripper_.beyond - options_.gap;
    const double extent = most_extent(thing_, approach);
    Vector3d result = position_ - std::max(0.0, extent - depth) * approach;
    const double half = half_extent(thing_, Vector3d::UnitZ());
    const Vector3d side = closing.cross(approach);
    const double below = std::abs(approach.z()) * gripper_.beyond +
                         std::abs(side.z()) * gripper_.finger.x / 2 +
                         std::abs(closing.z()) * (gripper_.widest / 2 + gripper_.finger.y);
    const double least = position_.z() - half + options_.gap + below;
    result.z() = std::max(result.z(), least);
    if (result.z() - below > position_.z() + half - least_overlap)
      return {};
    // Fingers that close on a raised place from above and below would run into the thing.
    if (std::abs((result - position_).dot(closing)) > options_.spare / 4)
      return {};
    return result;
  }

  void add(const Vector3d& at, const Vector3d& approach, const Vector3d& closing, double tilt,
           double width) {
    Eigen::Matrix3d axes;
    axes << closing.cross(approach), closing, approach;
    const Pose tool{geometry::to_point(at), geometry::to_rotation(Eigen::Quaterniond(axes)),
                    thing_.pose.frame};
    if (is_between_pads(gripper_, thing_, tool, rim))
      result_.push_back({tool, tilt, width});
  }

  const Gripper& gripper_;
  const NamedSolid& thing_;
  const GraspOptions& options_;
  int turns_;
  Vector3d position_;
  std::vector<GraspCandidate> result_;
};

} // namespace

double way_out(const ArmModel& arm, const NamedSolid& thing, const Pose& tool,
               const GraspOptions& options) {
  const auto z_axis = geometry::rotate(tool.rotation, Point3{0, 0, 1});
  const Vector3d axis = geometry::to_eigen(z_axis);
  const double past_middle =
    (geometry::to_eigen(tool.position) - geometry::to_eigen(thing.pose.position)).dot(axis);
  const double beside = past_middle + arm.gripper->beyond + most_extent(thing, axis);
  return std::max(options.approach, beside + options.gap + thing.uncertainty);
}

double half_extent(const NamedSolid& thing, const Point3& direction) {
  // The rotation that brings the direction up.
  const auto up =
    Eigen::Quaterniond::FromTwoVectors(geometry::to_eigen(direction), Vector3d::UnitZ());
  return half_height(thing.solid,
                     geometry::to_rotation(up * geometry::to_eigen(thing.pose.rotation)));
}

double least_width(const Solid& solid) {
  return std::min({solid.size.x, solid.size.y, solid.size.z});
}

bool is_between_pads(const Gripper& gripper, const NamedSolid& thing, const Pose& tool,
                     double rim) {
  if (thing.solid.kind == SolidKind::box)
    return true;
  const Eigen::Matrix3d axes = geometry::to_eigen(tool.rotation).toRotationMatrix();
  Vector3d off = geometry::to_eigen(thing.pose.position) - geometry::to_eigen(tool.position);
  if (thing.solid.kind != SolidKind::sphere) {
    const Vector3d axis = geometry::to_eigen(thing.pose.rotation).toRotationMatrix().col(2);
    if (std::abs(axis.dot(axes.col(1))) > std::sqrt(0.5))
      return true;
    off -= off.dot(axis) * axis;
  }
  const double beyond = off.dot(axes.col(2));
  return std::abs(off.dot(axes.col(0))) <= gripper.finger.x / 2 - rim &&
         beyond <= gripper.beyond - rim && beyond >= gripper.beyond - gripper.finger.z + rim;
}

std::vector<GraspCandidate> grasp_candidates(const ArmModel& arm, const NamedSolid& thing,
                                             bool follows_turret, const GraspOptions& options) {
  if (!arm.gripper)
    return {};
  return Candidates(arm, thing, options).all(follows_turret);
}

} // namespace castor::manipulation
