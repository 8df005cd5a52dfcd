#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "castor/benchmarks/clevr/clevr_scenes.hpp"
#include "castor/benchmarks/clevr/shape_training.hpp"

namespace castor::clevr {

/// Minimum overlap for which a region shows an object.
inline constexpr double sample_overlap = 0.5;

/// Training data of the committed network: number and seed of rendered pictures, and weight of an
/// object in a CLEVR image relative to them; number of damaged variants of each region.
inline constexpr int rendered_scenes = 1000;
inline constexpr std::uint32_t rendered_seed = 7;
inline constexpr double clevr_weight = 20;
inline constexpr int clevr_damages = 4;
inline constexpr int rendered_damages = 1;

/// Samples of the objects in CLEVR images as segmented, each also mirrored, damaged, and without
/// what needs a camera.
/// \param weight of each sample.
/// \throws std::runtime_error if an image cannot be read.
std::vector<Sample> clevr_samples(std::span<const Scene> scenes, double weight);

/// The same from `count` rendered pictures of random tables with random things on them, solid and
/// flat, under random cameras. The scenes are numbered on from `first_scene`.
std::vector<Sample> rendered_samples(int count, std::uint32_t seed, std::size_t first_scene);

} // namespace castor::clevr
