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
  /// Weight in the loss.
  double weight = 1;
  /// Index of its image.
  std::size_t scene = 0;
};

/// Options of the training.
struct TrainingOptions {
  int hidden = 24;
  int epochs = 20;
  std::size_t batch = 32;
  double learning_rate = 3e-3;
  /// Weight decay per step, times the learning rate.
  double decay = 0.03;
  std::uint32_t seed = 1;
};

/// Trains a shape classifier: minimises the cross entropy by Adam (D. Kingma and J. Ba, 2015) with
/// decoupled weight decay. Deterministic.
/// \pre there are samples, all with evidence of the same length.
vision::ShapeNetwork train(std::span<const Sample* const> samples, const TrainingOptions& options);

} // namespace castor::clevr
