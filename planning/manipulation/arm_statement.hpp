#pragma once

#include "castor/base/statement_words.hpp"
#include "castor/planning/manipulation/arm_model.hpp"

#include <string>
#include <utility>
#include <vector>

/// Parsers of the statements of an arm's file, for arm_file.hpp.
namespace castor::manipulation {

/// First words of statements.
const std::vector<std::string>& arm_keywords();

// Each parses the rest of a line, after its first word.
// \throws StatementError

/// NAME moves LINK at X Y Z [turned ROLL PITCH YAW] axis x|y|z|X Y Z from A to B speed S
/// acceleration A; of a fixed joint: NAME carries LINK at X Y Z [turned ROLL PITCH YAW].
std::pair<Joint, Link> read_joint(StatementWords& words, JointKind kind);

/// box LENGTH WIDTH HEIGHT | cylinder DIAMETER HEIGHT | capsule DIAMETER LENGTH | sphere DIAMETER
/// [at X Y Z] [turned ROLL PITCH YAW]
PlacedSolid read_shape(StatementWords& words);

/// at X Y Z [turned ROLL PITCH YAW]
Pose read_arm_pose(StatementWords& words, const std::string& of_what);

/// opens A to B speed S fingers WIDTH THICKNESS LENGTH beyond L
Gripper read_gripper(StatementWords& words);

/// One number for each joint that moves: degrees, of slides metres.
/// \throws StatementError for another count of numbers, or one outside of the joint's limits.
Configuration read_home(StatementWords& words, const ArmModel& arm);

/// The rotation about the fixed x, y and z axes, one after the other; radians.
geometry::Rotation roll_pitch_yaw(double roll, double pitch, double yaw);

} // namespace castor::manipulation
