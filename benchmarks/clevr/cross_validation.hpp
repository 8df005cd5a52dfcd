#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "castor/benchmarks/clevr/clevr_camera.hpp"
#include "castor/benchmarks/clevr/clevr_scenes.hpp"
#include "castor/benchmarks/clevr/evaluation.hpp"

namespace castor::clevr {

/// The camera that explains all of these scenes best; those with images of another size than the
/// first do not count.
CameraGuess usual_camera(std::span<const Scene* const> scenes);

/// Evaluates all images with the network that comes with Castor.
std::vector<Outcome> evaluate_all(const std::vector<Scene>& scenes,
                                  const vision::RegionOptions& options);

/// Evaluates each image with a network and a camera that were estimated from the images of the
/// other groups, and rendered pictures.
///
/// \param groups of each scene: those with the same number are left out together.
std::vector<Outcome> cross_validate(const std::vector<Scene>& scenes,
                                    std::span<const std::size_t> groups,
                                    const vision::RegionOptions& options);

} // namespace castor::clevr
