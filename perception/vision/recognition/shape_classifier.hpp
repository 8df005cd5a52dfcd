#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// What is said of a ball or a disc where they cannot be told apart.
inline constexpr const char* round_shape = "round";

/// Names of the shapes: solids, then flat pieces on the table.
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

/// A word that differs between networks, whose hidden values cannot be compared: 8 hexadecimal
/// digits.
std::string identity(const ShapeNetwork& network);

/// The values of the hidden units for `evidence`.
std::vector<double> hidden_values(const ShapeNetwork& network, std::span<const double> evidence);

/// The probability of each output for the given hidden values; they sum to 1.
std::vector<double> output_values(const ShapeNetwork& network, std::span<const double> hidden);

/// Prior knowledge of shapes.
struct ShapeOptions {
  /// Possible names; all of the vocabulary if empty.
  std::vector<std::string> candidates{};
  /// If the best shape has less confidence than this, "unknown" comes before it.
  double min_confidence = 0.4;
  /// Whether the camera is known. If not, a ball ("sphere") and a disc ("circle") look the same,
  /// and are both `round_shape`, unless only one of them is a candidate.
  bool tells_round_apart = true;
  /// Below that confidence, outlines decide.
  double sure = 0.9;
};

/// Shape names of a region, the likeliest first; confidences sum to 1.
///
/// \param evidence from measure_shape(); if empty, the result is "unknown" with confidence 1.
/// \param deviations from outline_deviations(): shapes are the less likely the further the outline
///        is from theirs; empty: it does not count.
/// \throws std::invalid_argument if it has another length than the network has inputs, or if no
///         candidate is of the vocabulary.
std::vector<Hypothesis> classify_shape(std::span<const double> evidence,
                                       const ShapeOptions& options = {},
                                       const ShapeNetwork& network = trained_shape_network(),
                                       const std::map<std::string, double>& deviations = {});

} // namespace castor::vision
