#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "castor/base/text_file.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// The scene language. A scene file has one statement per line; `#` begins a comment, case is
/// ignored. Lengths are metres, or have a unit: 0.06, 6cm, 60mm. The table's middle is 0 0, x goes
/// to the right and y away from the viewer.
///
/// The setting; every line is optional, with the defaults of this example:
///
///     table wood             # wood, cloth, plain; with a colour: table green cloth
///     camera 0 -0.75 0.70  looking-at 0 0 0  fov 50     # vertical angle, degrees
///     image 640 480          # what the camera delivers, pixels
///     light -1 -1 2          # the lamp's position
///     noise 2                # of the sensor: standard deviation in grey levels
///     seed 1                 # of the noise
///
/// The default extent of a table is 2 m x 2 m. Another one: table wood size 1.2 0.8
///
/// The objects, a colour and a shape each:
///
///     red cube        at 0.10 0.05  size 0.06  turned 30      # degrees, anticlockwise from above
///     green cylinder  at 0.0 0.2    size 5cm 8cm  name=mug    # diameter, height
///     #ff8000 box     at 0.2 0.2    size 0.10 0.05 0.04       # length, width, height
///
/// Colours are red, green, blue, yellow, orange, purple, pink, brown, black, white, grey, cyan,
/// magenta and #rrggbb; shapes are cube, box, cylinder, sphere, and, flat, square, rectangle,
/// triangle, disc. For sizes that are left out see size_of() in tabletop_scene_names.hpp.
///
/// Events, with times since the scene began. Objects are referred to by colour and shape, or by
/// name, as they are at that time:
///
///     after 2s     add yellow triangle at 0.2 0.1
///     after 3s     move red cube to -0.1 0.1 over 1s          # at once without "over"
///     after 500ms  remove mug
namespace castor::vision {

/// Result of parsing a scene.
struct TabletopSceneText {
  /// Incomplete, if there are errors among the problems.
  TabletopScene scene;
  /// Sorted by line.
  std::vector<Diagnostic> problems;
};

/// Parses `text`; `file_name` is for problems. Finds all problems at once, including those of
/// check_scene().
TabletopSceneText parse_tabletop_scene(std::string_view text, const std::string& file_name);

/// Reads a scene file; the problems of the result are warnings.
/// \throws TextFileError with all errors, if the file cannot be read or has errors.
TabletopSceneText load_tabletop_scene(const std::filesystem::path& path);

} // namespace castor::vision
