#pragma once

#include "castor/benchmarks/semeval/corpus.hpp"

#include "castor/benchmarks/semeval/robot_commands/command_interpreter.hpp"

#include <span>

namespace castor::semeval {

struct WeightTraining {
  int epochs = 12;
  double learning_rate = 0.2;
  /// Of the squared weights, per command.
  double regularisation = 5e-4;
};

/// Learns the weights of readings: a log-linear model of the annotated tree among all that the
/// parser finds, by AdaGrad. The same commands in the same order give the same weights.
CommandWeights learn_weights(std::shared_ptr<const communication::Lexicon> lexicon,
                             std::span<const Command* const> commands,
                             const WeightTraining& training = {});

} // namespace castor::semeval
