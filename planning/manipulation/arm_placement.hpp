#pragma once

#include "castor/planning/manipulation/arm_model.hpp"

#include <string>

/// Where an arm stands and how it rests, as options of components say it.
namespace castor::manipulation {

/// Pose of the arm's base in the table's frame, on its surface: "X Y", or "X Y heading DEGREES" of
/// the arm's x axis, anticlockwise from the table's.
/// \throws std::invalid_argument if the text is written otherwise.
Pose arm_placement(const std::string& text);

/// A number for each joint that moves, degrees, of slides metres; the arm's home if it is empty.
/// \throws std::invalid_argument if the text is written otherwise, or a limit is not kept.
Configuration arm_posture(const ArmModel& arm, const std::string& text);

} // namespace castor::manipulation
