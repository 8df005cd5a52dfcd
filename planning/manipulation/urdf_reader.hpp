#pragma once

#include "castor/planning/manipulation/arm_file.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace castor::manipulation {

/// What a URDF file does not say.
struct UrdfOptions {
  /// The link that the tool is on; may be empty if only one link carries no other.
  std::string tip;
  /// The tool's frame on that link; z is the direction that the arm grasps in.
  Pose tool;
  std::optional<Gripper> gripper;
  /// How long a joint takes to reach its speed, seconds: URDF has no accelerations.
  double time_to_speed = 0.5;
};

/// Parses the description of an arm in URDF (http://wiki.ros.org/urdf/XML): the chain from its root
/// to the tip. Links beside the chain belong to the link that carries them, with their joints at 0;
/// joints without an end are limited to one turn. Shapes are those of <collision>: box, cylinder
/// and sphere; a mesh is left out, with a warning. `file_name` is for problems; finds all at once.
ArmText parse_urdf(const std::string& text, const std::string& file_name,
                   const UrdfOptions& options = {});

/// Reads an arm's file in URDF; the problems of the result are warnings.
/// \throws TextFileError with all errors, if the file cannot be read or has errors.
ArmText load_urdf(const std::filesystem::path& path, const UrdfOptions& options = {});

} // namespace castor::manipulation
