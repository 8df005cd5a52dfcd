#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "castor/base/text_file.hpp"
#include "castor/perception/vision/types.hpp"

/// The file in which a user describes a real camera. `#` begins a comment; the order of the lines
/// does not matter:
///
///     size 640 480            # pixels; required
///     focal 612.4 611.9       # fx fy, pixels; or instead "fov 45", the vertical angle in degrees
///     centre 318.2 243.7      # principal point, pixels; the middle of the image if left out
///     distortion k1 -0.21 k2 0.06 t1 0.0004     # any of k1 k2 k3 t1 t2; the others are zero
///     eye 0 -0.9 0.7          # where the camera is, metres, the table's middle is 0 0 0; required
///     target 0 0 0            # a point that it sees at the principal point; required
///     number 1                # which camera it is; 0 if left out
///     frame base              # frame of eye and target, in lower case; "table" if left out
///
/// Metres may be written with a unit: 90cm, 900mm. The horizon is taken to be level in the image.
/// Calibration tools that list five bare distortion numbers usually mean k1 k2 t1 t2 k3.
namespace castor::vision {

/// Result of parsing: a camera, or at least one error among the problems.
struct CameraText {
  std::optional<Camera> camera;
  std::vector<Diagnostic> problems;
};

/// Parses `text`; `file_name` is for problems.
CameraText parse_camera(std::string_view text, const std::string& file_name);

/// \throws TextFileError with all errors, if the file cannot be read or has errors.
Camera load_camera(const std::filesystem::path& path);

} // namespace castor::vision
