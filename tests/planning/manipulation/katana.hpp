#pragma once

#include "castor/planning/manipulation/arm_file.hpp"

#include <random>
#include <string>

namespace castor::manipulation {

/// The arm of configs/arms.
inline ArmModel katana() {
  return load_arm(std::string(CASTOR_CONFIGS) + "/arms/katana.arm").arm;
}

/// A thing that stands as it is in the arm's frame.
inline NamedSolid thing(const std::string& name, const Solid& solid, double x, double y, double z) {
  return {name, solid, {{x, y, z}, {}, arm_frame}};
}

/// A configuration within the limits.
inline Configuration random_configuration(const ArmModel& arm, std::mt19937& random) {
  Configuration result;
  for (auto index : moving_joints(arm))
    result.push_back(
      std::uniform_real_distribution(arm.joints[index].lower, arm.joints[index].upper)(random));
  return result;
}

/// Six turning joints, none of which lie as those of the Katana do.
inline ArmModel six_joints() {
  return parse_arm(
           "arm six\n"
           "base stand\n"
           "joint j1 moves l1 at 0 0 0.3 axis z from -170 to 170 speed 90 acceleration 180\n"
           "joint j2 moves l2 at 0.05 0 0.1 axis y from -120 to 120 speed 90 acceleration 180\n"
           "joint j3 moves l3 at 0 0 0.3 axis y from -150 to 150 speed 90 acceleration 180\n"
           "joint j4 moves l4 at 0.02 0 0.1 axis z from -170 to 170 speed 90 acceleration 180\n"
           "joint j5 moves l5 at 0 0 0.2 axis y from -120 to 120 speed 90 acceleration 180\n"
           "joint j6 moves l6 at 0 0 0.06 axis z from -170 to 170 speed 90 acceleration 180\n"
           "shape sphere 0.03\n"
           "tool at 0 0 0.1\n",
           "six.arm")
    .arm;
}

} // namespace castor::manipulation
