#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "castor/perception/vision/recognition/shape_classifier.hpp"

namespace castor::clevr {

/// A region whose shape is known.
struct Sample {
  std::vector<double> evidence;
  /// An index in the shape vocabulary.
  std::size_t shape = 0;
  /// How much it counts.
  double weight = 1;
  /// The image it was seen in.
  std::size_t scene = 0;
};

/// How the network learns.
struct TrainingOptions {
  int hidden = 24;
  int epochs = 20;
  std::size_t batch = 32;
  double learning_rate = 3e-3;
  /// Each weight loses this share of itself times the learning rate per step.
  double decay = 0.1;
  std::uint32_t seed = 1;
};

/// A network that tells the samples' shapes: minimises the cross entropy by Adam (D. Kingma and
/// J. Ba, 2015) with decoupled weight decay. Deterministic.
/// \pre there are samples, all with evidence of the same length.
vision::ShapeNetwork train(std::span<const Sample* const> samples, const TrainingOptions& options);

} // namespace castor::clevr
