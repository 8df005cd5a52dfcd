#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "castor/benchmarks/clevr/clevr_scenes.hpp"
#include "castor/perception/vision/types.hpp"

namespace castor::clevr {

/// CLEVR's camera looks at a point near the origin; where from is another place in each image.
/// Lengths are CLEVR's units.
struct CameraGuess {
  std::array<double, 3> position{7.5, -6.5, 5.2};
  /// On the ground.
  std::array<double, 2> target{};
};

/// The camera for images of this size, with `metres_per_unit` metres for a CLEVR unit. CLEVR's lens
/// of 35 mm before a sensor 32 mm wide gives the angle of view.
vision::Camera make_camera(const CameraGuess& guess, int width, int height, double metres_per_unit);

/// The same camera in a file for the component Camera (`--calibration`).
std::string camera_file(const CameraGuess& guess, int width, int height, double metres_per_unit);

/// The one camera that explains all objects of the scenes best, in the sense of least squares.
///
/// \param start is held against what the scenes say, as if it were known within `tolerance` units
///        for the position, and a tenth of that for the target.
CameraGuess fit_camera(std::span<const Scene* const> scenes, const CameraGuess& start,
                       double tolerance, int width, int height);

} // namespace castor::clevr
