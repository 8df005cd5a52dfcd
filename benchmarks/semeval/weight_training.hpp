#pragma once

#include "castor/benchmarks/semeval/corpus.hpp"

#include "castor/benchmarks/semeval/robot_commands/command_interpreter.hpp"

#include <span>

namespace castor::semeval {

struct WeightTraining {
  int epochs = 12;
  double learning_rate = 0.2;
  /// Weight of the squared weights, per command.
  double regularisation = 5e-4;
};

/// Learns the weights of readings: a log-linear model of the annotated tree among all parses, by
/// AdaGrad. Deterministic for the same commands in the same order.
CommandWeights learn_weights(std::shared_ptr<const communication::Lexicon> lexicon,
                             std::span<const Command* const> commands,
                             const WeightTraining& training = {});

} // namespace castor::semeval
