#include "castor/communication/parsing/linear_classifier.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <random>

namespace castor::communication {

namespace {

/// How much a wrong sample costs, against the length of the weights. By the lexicon's examples,
/// each tenth of them classified by the others.
constexpr float cost = 3;

/// How often all samples are gone through: more of them gained nothing.
constexpr int epochs = 5;

} // namespace

LinearClassifier::LinearClassifier(std::span<const Sample> samples, std::size_t features,
                                   std::size_t classes)
  : classes_{classes}, weights_(features * classes) {
  constexpr float diagonal = 1 / (2 * cost);
  std::vector<float> multipliers(samples.size() * classes);
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), 0);
  std::minstd_rand random;
  std::vector<float> steps(classes);
  for (int epoch = 0; epoch < epochs; ++epoch) {
    // Not std::shuffle, whose order is up to the library.
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[random() % i]);
    for (const auto i : order) {
      const auto& sample = samples[i];
      assert(sample.label < classes);
      float square = diagonal;
      for (const auto& feature : sample.features)
        square += feature.value * feature.value;
      const auto score = scores(sample.features);
      auto* multiplier = &multipliers[i * classes];
      for (std::size_t k = 0; k < classes; ++k) {
        const float sign = k == sample.label ? 1.F : -1.F;
        const auto gradient = sign * score[k] - 1 + multiplier[k] * diagonal;
        const auto next = std::max(multiplier[k] - gradient / square, 0.F);
        steps[k] = (next - multiplier[k]) * sign;
        multiplier[k] = next;
      }
      for (const auto& feature : sample.features) {
        auto* weight = &weights_[feature.index * classes];
        for (std::size_t k = 0; k < classes; ++k)
          weight[k] += feature.value * steps[k];
      }
    }
  }
}

std::vector<float> LinearClassifier::scores(std::span<const Feature> features) const {
  std::vector<float> result(classes_);
  for (const auto& feature : features) {
    const auto* weight = &weights_[feature.index * classes_];
    for (std::size_t k = 0; k < classes_; ++k)
      result[k] += feature.value * weight[k];
  }
  return result;
}

} // namespace castor::communication
