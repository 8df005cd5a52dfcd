#include "castor/perception/vision/learning/word_learner.hpp"

#include "castor/perception/vision/recognition/shape_classifier.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace castor::vision {

namespace {

const std::string colour_kind = "colour";
const std::string shape_kind = "shape";

std::size_t dimensions(const std::string& kind) {
  return kind == colour_kind ? 3 : static_cast<std::size_t>(trained_shape_network().hidden);
}

bool precedes(const LearnedWord& a, const LearnedWord& b) {
  return std::tie(a.kind, a.word) < std::tie(b.kind, b.word);
}

double squared_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

} // namespace

bool WordLearner::is_kind(const std::string& kind) {
  return kind == colour_kind || kind == shape_kind;
}

std::string WordLearner::problem_of(const LearnedWord& x) {
  if (!is_kind(x.kind))
    return "'" + x.kind + "' is no kind of word; there are words for a colour and for a shape";
  auto is_bad = [](unsigned char c) { return std::isspace(c) || c == '#' || std::isupper(c); };
  if (x.word.empty() || x.word == Hypothesis{}.value ||
      std::any_of(x.word.begin(), x.word.end(), is_bad))
    return "'" + x.word + "' cannot be learned: a word is one word, and not 'unknown'";
  if (!(x.examples > 0) || !std::isfinite(x.examples))
    return "the number of examples is not positive";
  if (!(x.scatter >= 0) || !std::isfinite(x.scatter))
    return "the scatter is negative";
  if (x.mean.size() != dimensions(x.kind))
    return "the evidence for a " + x.kind + " has " + std::to_string(dimensions(x.kind)) +
           " numbers, not " + std::to_string(x.mean.size());
  if (!std::all_of(x.mean.begin(), x.mean.end(), [](double n) { return std::isfinite(n); }))
    return "the evidence is not finite";
  return {};
}

WordLearner::WordLearner(std::vector<LearnedWord> words, LearningOptions options)
  : options_(options), words_(std::move(words)) {
  for (auto& x : words_)
    if (auto problem = problem_of(x); !problem.empty())
      throw std::invalid_argument(problem);
  std::sort(words_.begin(), words_.end(), precedes);
}

std::vector<double> WordLearner::evidence(const std::string& kind, const RegionFeatures& features) {
  if (kind == colour_kind)
    return features.colour_evidence;
  // The network was trained to see what matters of the measurements: directions and light do not.
  auto& network = trained_shape_network();
  if (kind != shape_kind ||
      features.shape_evidence.size() != static_cast<std::size_t>(network.inputs))
    return {};
  return hidden_values(network, features.shape_evidence);
}

void WordLearner::learn(const std::string& kind, const std::string& word,
                        const std::vector<double>& evidence, double weight) {
  LearnedWord example{kind, word, weight, evidence, 0};
  for (auto& c : example.word)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (auto problem = problem_of(example); !problem.empty())
    throw std::invalid_argument(problem);
  if (weight > 1)
    throw std::invalid_argument("an example has a weight of 1 at most");
  auto at = std::lower_bound(words_.begin(), words_.end(), example, precedes);
  if (at == words_.end() || precedes(example, *at)) {
    words_.insert(at, std::move(example));
    return;
  }
  // T. F. Chan, G. H. Golub and R. J. LeVeque, "Updating formulae and a pairwise algorithm for
  // computing sample variances" (1979).
  auto sum = at->examples + weight;
  at->scatter += squared_distance(at->mean, evidence) * at->examples * weight / sum;
  for (std::size_t i = 0; i < evidence.size(); ++i)
    at->mean[i] += (evidence[i] - at->mean[i]) * weight / sum;
  at->examples = sum;
}

std::vector<Hypothesis> WordLearner::name(const std::string& kind,
                                          const std::vector<double>& evidence) const {
  auto prior = kind == colour_kind ? options_.colour_spread : options_.shape_spread;
  // What fits exactly as well as something at the end of a word's reach may as well be unknown.
  auto nothing = std::exp(-options_.reach * options_.reach / 2);
  std::vector<Hypothesis> result{{Hypothesis{}.value, nothing}};
  auto sum = nothing;
  for (auto& x : words_) {
    if (x.kind != kind || x.mean.size() != evidence.size())
      continue;
    auto axes = static_cast<double>(evidence.size());
    auto variance = (options_.prior_examples * prior * prior + x.scatter / axes) /
                    (options_.prior_examples + x.examples);
    // The mean itself is only known so well.
    variance += variance / x.examples;
    auto fit = std::exp(-squared_distance(x.mean, evidence) / axes / variance / 2);
    result.push_back({x.word, fit});
    sum += fit;
  }
  for (auto& x : result)
    x.confidence /= sum;
  std::stable_sort(result.begin(), result.end(),
                   [](auto& a, auto& b) { return a.confidence > b.confidence; });
  return result;
}

} // namespace castor::vision
