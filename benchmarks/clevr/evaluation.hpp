#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "castor/benchmarks/clevr/clevr_camera.hpp"
#include "castor/benchmarks/clevr/clevr_scenes.hpp"
#include "castor/benchmarks/clevr/matching.hpp"
#include "castor/perception/vision/recognition/regions.hpp"

namespace castor::clevr {

/// Length of CLEVR's unit, chosen so that its two sizes are on either side of
/// SizeOptions::large_from.
inline constexpr double metres_per_unit = 0.088;

/// Minimum overlap for which an object counts as found.
inline constexpr double found_overlap = 0.5;

/// Result for one image.
struct Outcome {
  const Scene* scene = nullptr;
  std::vector<vision::Region> regions;
  /// Pairs that overlap at least `found_overlap`.
  std::vector<Match> matches;
  /// Number of pairs at a minimum overlap of 0.3.
  std::size_t loose_matches = 0;
  /// Number of objects with their pixel_coords in the box of a region, one to one.
  std::size_t box_hits = 0;
  /// Time from the image to the last decision.
  double milliseconds = 0;
};

/// Runs all steps on the scene's image.
///
/// \param usual the camera to measure sizes with; the scene's own, from its scene graph, is used
/// for
///        nothing but to know which object is seen where.
/// \throws std::runtime_error if the image cannot be read.
Outcome evaluate(const Scene& scene, const CameraGuess& usual, const vision::RegionOptions& options,
                 const vision::ShapeNetwork& network);

/// Hits among all cases.
struct Tally {
  std::size_t hits = 0;
  std::size_t all = 0;

  void add(bool hit) {
    hits += hit ? 1 : 0;
    ++all;
  }
};

/// Words that were said with about the same confidence.
struct ConfidenceBin {
  /// Sum of their confidences.
  double confidence = 0;
  Tally right;
};

/// By tenths of confidence.
using Reliability = std::array<ConfidenceBin, 10>;

/// Sums over all images.
struct Summary {
  Tally recall;
  Tally precision;
  Tally loose_recall;
  Tally box_recall;
  /// Correct properties of the objects found.
  Tally colour;
  Tally shape;
  Tally size;
  std::map<std::string, Tally> shape_by_material;
  /// By kind of word: colour, shape, size.
  std::map<std::string, Reliability> reliability;
  /// By true shape, then by the decision: cube, cylinder, sphere, anything else.
  std::array<std::array<std::size_t, 4>, 3> shapes{};
  std::vector<double> milliseconds;
  double overlap_sum = 0;
};

Summary summarize(const std::vector<Outcome>& outcomes);

} // namespace castor::clevr
