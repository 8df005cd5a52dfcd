#include "castor/perception/vision/recognition/shape_classifier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>

#include "castor/perception/vision/recognition/shape_evidence.hpp"

namespace castor::vision {

namespace {

constexpr int trained_hidden = 24;

/// Balls and discs as one hypothesis, if there are both.
void join_round(std::vector<Hypothesis>& shapes) {
  const auto is_round = [](const Hypothesis& x) {
    return x.value == "sphere" || x.value == "circle";
  };
  if (std::count_if(shapes.begin(), shapes.end(), is_round) < 2)
    return;
  Hypothesis joint{round_shape, 0};
  for (const auto& shape : shapes)
    joint.confidence += is_round(shape) ? shape.confidence : 0;
  std::erase_if(shapes, is_round);
  shapes.push_back(joint);
}

/// By how far the outline is from that of each shape.
void weigh(std::vector<Hypothesis>& shapes, const std::map<std::string, double>& deviations) {
  // A shape whose outline is so much further off is less likely by the factor e.
  constexpr double scale = 0.005;
  // How much further than the best the outlines of those are that are not fitted.
  constexpr double usual = 0.0075;
  // Outlines that fit no shape so well are those of things that are partly hidden.
  constexpr double good = 0.03;
  const double best =
    std::ranges::min_element(deviations, {}, [](const auto& x) { return x.second; })->second;
  if (best > good)
    return;
  for (auto& shape : shapes) {
    const auto found = deviations.find(shape.value);
    const double more = found == deviations.end() ? usual : found->second - best;
    shape.confidence *= std::exp(-more / scale);
  }
}

} // namespace

const std::vector<std::string>& shape_vocabulary() {
  static const std::vector<std::string> vocabulary{"cube",      "cylinder", "sphere", "square",
                                                   "rectangle", "triangle", "circle"};
  return vocabulary;
}

std::size_t ShapeNetwork::size() const {
  return static_cast<std::size_t>(hidden * (inputs + 1) + outputs * (hidden + 1));
}

const ShapeNetwork& trained_shape_network() {
  static const ShapeNetwork network{static_cast<int>(shape_measurements().size()),
                                    trained_hidden,
                                    static_cast<int>(shape_vocabulary().size()),
                                    {
#include "castor/perception/vision/recognition/shape_table.inc"
                                    }};
  return network;
}

std::string identity(const ShapeNetwork& network) {
  // FNV-1a, of the weights' bits.
  std::uint32_t hash = 2166136261U;
  for (const float weight : network.weights) {
    hash ^= std::bit_cast<std::uint32_t>(weight);
    hash *= 16777619U;
  }
  return fmt::format("{:08x}", hash);
}

std::vector<double> hidden_values(const ShapeNetwork& network, std::span<const double> evidence) {
  std::vector<double> values;
  auto weight = network.weights.begin();
  for (int unit = 0; unit < network.hidden; ++unit) {
    double sum = *weight++;
    for (const double number : evidence)
      sum += number * *weight++;
    values.push_back(std::tanh(sum));
  }
  return values;
}

std::vector<double> output_values(const ShapeNetwork& network, std::span<const double> hidden) {
  std::vector<double> values;
  auto weight = network.weights.begin() + network.hidden * (network.inputs + 1);
  for (int output = 0; output < network.outputs; ++output) {
    double sum = *weight++;
    for (const double number : hidden)
      sum += number * *weight++;
    values.push_back(sum);
  }
  const double largest = *std::max_element(values.begin(), values.end());
  double total = 0;
  for (double& value : values) {
    value = std::exp(value - largest);
    total += value;
  }
  for (double& value : values)
    value /= total;
  return values;
}

std::vector<Hypothesis> classify_shape(std::span<const double> evidence,
                                       const ShapeOptions& options, const ShapeNetwork& network,
                                       const std::map<std::string, double>& deviations) {
  if (evidence.empty())
    return {{"unknown", 1}};
  if (evidence.size() != static_cast<std::size_t>(network.inputs) ||
      network.weights.size() != network.size())
    throw std::invalid_argument("classify_shape: the evidence does not fit the network");
  const auto shares = output_values(network, hidden_values(network, evidence));
  std::vector<Hypothesis> result;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const auto& name = shape_vocabulary()[i];
    const auto& candidates = options.candidates;
    if (!candidates.empty() &&
        std::find(candidates.begin(), candidates.end(), name) == candidates.end())
      continue;
    result.push_back({name, shares[i]});
  }
  if (result.empty())
    throw std::invalid_argument("classify_shape: no candidate is of the vocabulary");
  if (!deviations.empty())
    weigh(result, deviations);
  double total = 0;
  for (const auto& hypothesis : result)
    total += hypothesis.confidence;
  for (auto& hypothesis : result)
    hypothesis.confidence /= total;
  if (!options.tells_round_apart)
    join_round(result);
  std::stable_sort(result.begin(), result.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.confidence > b.confidence;
  });
  const double best = result.front().confidence;
  if (best < options.min_confidence) {
    // What is missing to certainty is more than what speaks for any shape.
    for (auto& hypothesis : result)
      hypothesis.confidence *= best;
    result.insert(result.begin(), {"unknown", 1 - best});
  }
  return result;
}

} // namespace castor::vision
