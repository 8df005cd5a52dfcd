#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "castor/benchmarks/clevr/clevr_scenes.hpp"
#include "castor/perception/vision/types.hpp"

namespace castor::clevr {

/// CLEVR's camera looks at a point near the origin; its position differs from image to image.
/// Lengths are CLEVR's units.
struct CameraGuess {
  std::array<double, 3> position{7.5, -6.5, 5.2};
  /// Point on the ground.
  std::array<double, 2> target{};
};

/// The camera for images of this size, with `metres_per_unit` metres for a CLEVR unit. CLEVR's lens
/// of 35 mm before a sensor 32 mm wide gives the angle of view.
geometry::Camera make_camera(const CameraGuess& guess, int width, int height,
                             double metres_per_unit);

/// Text of a calibration file with the same camera, for the component Camera (`--calibration`).
std::string camera_file(const CameraGuess& guess, int width, int height, double metres_per_unit);

/// Fits one camera to all objects of the scenes, by least squares.
///
/// \param start prior, with a standard deviation of `tolerance` units for the position, and a tenth
///        of that for the target.
CameraGuess fit_camera(std::span<const Scene* const> scenes, const CameraGuess& start,
                       double tolerance, int width, int height);

} // namespace castor::clevr
