#include "castor/benchmarks/semeval/weight_training.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <unordered_map>

namespace castor::semeval {

namespace {

struct Example {
  struct Reading {
    std::vector<std::pair<std::uint32_t, float>> features;
    bool is_right = false;
  };
  std::vector<Reading> readings;
};

class LogLinearModel {
public:
  explicit LogLinearModel(const WeightTraining& training) : training_(training) {
    // nop
  }

  /// Adds what the parser makes of a command, unless none of it is right, or all.
  void add(std::vector<CommandCandidate> candidates, const std::string& right) {
    Example example;
    std::size_t right_ones = 0;
    for (const auto& candidate : candidates) {
      Example::Reading reading;
      for (const auto& feature : candidate.features)
        reading.features.emplace_back(number(feature.name), static_cast<float>(feature.value));
      reading.is_right = to_string(candidate.tree) == right;
      right_ones += reading.is_right ? 1 : 0;
      example.readings.push_back(std::move(reading));
    }
    if (right_ones > 0 && right_ones < candidates.size())
      examples_.push_back(std::move(example));
  }

  std::unordered_map<std::string, double> train() {
    weights_.assign(numbers_.size(), 0);
    squares_.assign(numbers_.size(), 1e-6);
    if (const auto lexical = numbers_.find("lexical"); lexical != numbers_.end())
      weights_[lexical->second] = 1;
    std::vector<std::size_t> order(examples_.size());
    std::iota(order.begin(), order.end(), 0);
    std::mt19937 random(1);
    for (int epoch = 0; epoch < training_.epochs; ++epoch) {
      std::shuffle(order.begin(), order.end(), random);
      for (const auto i : order)
        learn(examples_[i]);
    }
    std::unordered_map<std::string, double> named;
    for (const auto& [name, number] : numbers_)
      named[name] = weights_[number];
    return named;
  }

private:
  std::uint32_t number(const std::string& name) {
    return numbers_.emplace(name, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }

  /// One step up the likelihood of the right readings together.
  void learn(const Example& example) {
    std::vector<double> scores;
    for (const auto& reading : example.readings) {
      double sum = 0;
      for (const auto& [feature, value] : reading.features)
        sum += weights_[feature] * static_cast<double>(value);
      scores.push_back(sum);
    }
    const double highest = *std::max_element(scores.begin(), scores.end());
    double all = 0;
    double right = 0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      scores[i] = std::exp(scores[i] - highest);
      all += scores[i];
      right += example.readings[i].is_right ? scores[i] : 0;
    }
    gradient_.clear();
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const double wanted = example.readings[i].is_right && right > 0 ? scores[i] / right : 0;
      const double change = wanted - scores[i] / all;
      for (const auto& [feature, value] : example.readings[i].features)
        gradient_[feature] += change * static_cast<double>(value);
    }
    for (const auto& [feature, slope] : gradient_) {
      if (std::abs(slope) < 1e-9)
        continue;
      const double step = slope - training_.regularisation * weights_[feature];
      squares_[feature] += step * step;
      weights_[feature] += training_.learning_rate * step / std::sqrt(squares_[feature]);
    }
  }

  WeightTraining training_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::vector<Example> examples_;
  std::vector<double> weights_;
  std::vector<double> squares_;
  std::unordered_map<std::uint32_t, double> gradient_;
};

} // namespace

CommandWeights learn_weights(std::shared_ptr<const communication::Lexicon> lexicon,
                             std::span<const Command* const> commands,
                             const WeightTraining& training) {
  CommandInterpreter interpreter(std::move(lexicon), {});
  LogLinearModel with_board(training);
  LogLinearModel without_board(training);
  for (const auto* command : commands) {
    const auto right = to_string(command->tree);
    with_board.add(interpreter.candidates(command->text, &command->board), right);
    without_board.add(interpreter.candidates(command->text, nullptr), right);
  }
  return {with_board.train(), without_board.train()};
}

} // namespace castor::semeval
