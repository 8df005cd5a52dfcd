#pragma once

#include <span>
#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// The shapes that are told apart: solids, then flat pieces on the table.
const std::vector<std::string>& shape_vocabulary();

/// The parameters of a perceptron with one hidden layer of tanh units and a softmax output.
struct ShapeNetwork {
  int inputs = 0;
  int hidden = 0;
  int outputs = 0;
  /// Per hidden unit, its bias and a weight per input; then per output, its bias and a weight per
  /// hidden unit.
  std::vector<float> weights;

  /// The number of weights that a network of these dimensions needs.
  std::size_t size() const;
};

/// The network that comes with Castor; see benchmarks/clevr/train_shapes.cpp for its training.
const ShapeNetwork& trained_shape_network();

/// The values of the hidden units for `evidence`.
std::vector<double> hidden_values(const ShapeNetwork& network, std::span<const double> evidence);

/// The probability of each output for the given hidden values; they sum to 1.
std::vector<double> output_values(const ShapeNetwork& network, std::span<const double> hidden);

/// What is known of shapes beforehand.
struct ShapeOptions {
  /// The names that occur here; all of the vocabulary, if empty.
  std::vector<std::string> candidates{};
  /// A best shape with less confidence than this is named second, after "unknown".
  double min_confidence = 0.4;
};

/// What shape a region has, the likeliest first; confidences sum to 1.
///
/// \param evidence as of measure_shape(); "unknown" with confidence 1 if it is empty.
/// \throws std::invalid_argument if it has another length than the network has inputs, or if no
///         candidate is of the vocabulary.
std::vector<Hypothesis> classify_shape(std::span<const double> evidence,
                                       const ShapeOptions& options = {},
                                       const ShapeNetwork& network = trained_shape_network());

} // namespace castor::vision
