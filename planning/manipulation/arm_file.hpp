#pragma once

#include "castor/base/text_file.hpp"
#include "castor/planning/manipulation/arm_model.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The file that describes an arm, from its base to its tool. It has one statement per line; `#`
/// begins a comment, case is ignored. Lengths are metres, or have a unit: 0.19, 19cm, 190mm; angles
/// are degrees, and speeds those per second. Three angles after "turned" are roll, pitch and yaw:
/// rotations about the x, y and z axes of the frame before, one after the other.
///
///     arm katana                                # its name
///     base stand                                # the link that stands still
///     shape cylinder 0.12 0.2 at 0 0 0.1        # of the link before: diameter, height
///     joint shoulder moves upper-arm at 0 0 0.2 axis y from -34 to 98 speed 68 acceleration 115
///     shape capsule 0.06 0.25 at 0 0 0.095      # diameter, length with its round ends
///     slide lift moves carriage at 0 0 0.19 axis z from 0 to 0.4 speed 0.2 acceleration 0.5
///     fixed wrist carries hand at 0 0 0.1 turned 0 90 0
///     shape box 0.04 0.1 0.03                   # length, width, height
///     tool at 0 0 0.15                          # on the last link; it grasps along its z axis
///
/// A gripper closes along the y axis of the tool; fingers have a width, a thickness and a length.
/// "home" has a number for each joint that moves:
///
///     gripper opens 0 to 0.1 speed 0.1 fingers 0.02 0.012 0.07 beyond 0.01
///     home 20 0.1
namespace castor::manipulation {

/// Result of parsing an arm's file.
struct ArmText {
  /// Incomplete, if there are errors among the problems.
  ArmModel arm;
  /// Sorted by line.
  std::vector<Diagnostic> problems;
};

/// Parses `text`; `file_name` is for problems. Finds all problems at once.
ArmText parse_arm(std::string_view text, const std::string& file_name);

/// Reads an arm's file; the problems of the result are warnings.
/// \throws TextFileError with all errors, if the file cannot be read or has errors.
ArmText load_arm(const std::filesystem::path& path);

} // namespace castor::manipulation
