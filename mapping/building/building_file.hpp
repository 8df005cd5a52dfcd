#pragma once

#include "castor/base/text_file.hpp"
#include "castor/mapping/building/building.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The file that describes a building. It has one statement per line; `#` begins a comment, case is
/// ignored. Lengths are metres, or have a unit: 0.85, 85cm, 850mm. x goes to the right, y up as
/// seen from above; angles are degrees, anticlockwise.
///
///     building office                       # its name
///     height 2.5                            # of walls
///     thickness 0.1                         # of the walls of the following lines
///     wall 0 0 to 8 0 to 8 5 to 0 5 close   # along the middle of the wall; "close" joins the ends
///     wall 5 0 to 5 5 thickness 0.15
///     door kitchen-door at 5 2.5 width 0.85 shut     # in the wall there; open if not said
///     room kitchen at 6 1                   # a point in it: walls and doors enclose it
///     room office-1 at 2 2 kind office
///
/// Furniture has a shape, and boxes are along the x axis unless they are turned; "legs": it is
/// solid only at its top and at its four legs. Objects are round:
///
///     furniture desk  at 1 1  box 1.6 0.8 0.75  turned 90 colour brown name=desk-1
///     furniture table at 6 3  disc 0.9 0.72  legs        # diameter, height
///     object mug at 6 3 on 0.72 size 0.08 0.1 colour red # diameter, height
///
/// People walk along a route and back, or in a loop, and pause at its points for some seconds if
/// they do; the robot begins at the start:
///
///     person ann route 1 2.5 to 7 2.5 speed 0.8 pause 2
///     start 2.5 2.5 heading 90
namespace castor::mapping {

/// Result of parsing a building's file.
struct BuildingText {
  /// Incomplete, if there are errors among the problems.
  Building building;
  /// Sorted by line.
  std::vector<Diagnostic> problems;
};

/// Parses `text`; `file_name` is for problems. Finds all problems at once, including those of
/// complete_building().
BuildingText parse_building(std::string_view text, const std::string& file_name);

/// Reads a building's file; the problems of the result are warnings.
/// \throws TextFileError with all errors, if the file cannot be read or has errors.
BuildingText load_building(const std::filesystem::path& path);

} // namespace castor::mapping
