#include "castor/benchmarks/clevr/shape_training.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace castor::clevr {

namespace {

using vision::ShapeNetwork;

/// Makes every measurement have mean 0 and deviation 1.
struct Scaling {
  std::vector<double> mean;
  std::vector<double> deviation;

  explicit Scaling(std::span<const Sample* const> samples)
    : mean(samples.front()->evidence.size()), deviation(mean.size()) {
    const auto count = static_cast<double>(samples.size());
    for (const auto* sample : samples) {
      for (std::size_t i = 0; i < mean.size(); ++i)
        mean[i] += sample->evidence[i] / count;
    }
    for (const auto* sample : samples) {
      for (std::size_t i = 0; i < mean.size(); ++i)
        deviation[i] += std::pow(sample->evidence[i] - mean[i], 2) / count;
    }
    for (double& value : deviation)
      value = std::sqrt(value) + 1e-3;
  }

  std::vector<double> operator()(const std::vector<double>& evidence) const {
    std::vector<double> result(evidence.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = (evidence[i] - mean[i]) / deviation[i];
    return result;
  }

  /// Lets the network take evidence as it is measured.
  void fold_into(ShapeNetwork& network) const {
    auto weight = network.weights.begin();
    for (int unit = 0; unit < network.hidden; ++unit) {
      float& bias = *weight++;
      for (std::size_t i = 0; i < mean.size(); ++i, ++weight) {
        *weight = static_cast<float>(*weight / deviation[i]);
        bias -= static_cast<float>(*weight * mean[i]);
      }
    }
  }
};

/// Adds the gradient of one sample's cross entropy.
void add_gradient(const ShapeNetwork& network, const std::vector<double>& input, std::size_t shape,
                  double weight, std::vector<double>& gradient) {
  const auto hidden = hidden_values(network, input);
  auto errors = output_values(network, hidden);
  errors[shape] -= 1;
  std::vector<double> hidden_errors(hidden.size());
  std::size_t at = hidden.size() * (input.size() + 1);
  for (const double error : errors) {
    gradient[at++] += weight * error;
    for (std::size_t unit = 0; unit < hidden.size(); ++unit, ++at) {
      hidden_errors[unit] += error * static_cast<double>(network.weights[at]);
      gradient[at] += weight * error * hidden[unit];
    }
  }
  at = 0;
  for (std::size_t unit = 0; unit < hidden.size(); ++unit) {
    const double error = weight * hidden_errors[unit] * (1 - hidden[unit] * hidden[unit]);
    gradient[at++] += error;
    for (const double number : input)
      gradient[at++] += error * number;
  }
}

class Adam {
public:
  explicit Adam(std::size_t size) : mean_(size), square_(size) {
    // nop
  }

  void step(std::vector<float>& weights, const std::vector<double>& gradient, double rate,
            double decay) {
    constexpr double keep_mean = 0.9;
    constexpr double keep_square = 0.999;
    ++steps_;
    const double mean_scale = 1 - std::pow(keep_mean, steps_);
    const double square_scale = 1 - std::pow(keep_square, steps_);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      mean_[i] = keep_mean * mean_[i] + (1 - keep_mean) * gradient[i];
      square_[i] = keep_square * square_[i] + (1 - keep_square) * gradient[i] * gradient[i];
      const double direction =
        mean_[i] / mean_scale / (std::sqrt(square_[i] / square_scale) + 1e-8);
      const auto weight = static_cast<double>(weights[i]);
      weights[i] = static_cast<float>(weight - rate * (direction + decay * weight));
    }
  }

private:
  std::vector<double> mean_;
  std::vector<double> square_;
  int steps_ = 0;
};

} // namespace

ShapeNetwork train(std::span<const Sample* const> samples, const TrainingOptions& options) {
  const Scaling scaling(samples);
  std::vector<std::vector<double>> inputs;
  for (const auto* sample : samples)
    inputs.push_back(scaling(sample->evidence));
  ShapeNetwork network{static_cast<int>(inputs.front().size()),
                       options.hidden,
                       static_cast<int>(vision::shape_vocabulary().size()),
                       {}};
  std::mt19937 random(options.seed);
  std::normal_distribution<float> initial(0, 0.1F);
  network.weights.resize(network.size());
  for (float& weight : network.weights)
    weight = initial(random);
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Adam adam(network.size());
  std::vector<double> gradient(network.size());
  for (int epoch = 0; epoch < options.epochs; ++epoch) {
    std::shuffle(order.begin(), order.end(), random);
    // The steps become smaller towards the end.
    const double rate = options.learning_rate * (1.0 - 0.95 * epoch / options.epochs);
    for (std::size_t begin = 0; begin < order.size(); begin += options.batch) {
      const std::size_t end = std::min(begin + options.batch, order.size());
      std::fill(gradient.begin(), gradient.end(), 0);
      for (std::size_t i = begin; i < end; ++i) {
        const Sample& sample = *samples[order[i]];
        add_gradient(network, inputs[order[i]], sample.shape,
                     sample.weight / static_cast<double>(end - begin), gradient);
      }
      adam.step(network.weights, gradient, rate, options.decay);
    }
  }
  scaling.fold_into(network);
  return network;
}

} // namespace castor::clevr
