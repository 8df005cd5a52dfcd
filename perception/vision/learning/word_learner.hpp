#pragma once

#include "castor/perception/vision/types.hpp"

#include <string>
#include <vector>

namespace castor::vision {

struct LearningOptions {
  /// Prior standard deviation, along each axis, of the evidence for one word about its mean. For
  /// colours in L*a*b* units, for shapes in hidden values of the shape network.
  double colour_spread = 6;
  double shape_spread = 0.3;
  /// Weight of the prior, as a number of examples.
  double prior_examples = 3;
  /// Maximum distance of evidence from a word's mean for which the word applies: in standard
  /// deviations along each axis, root mean square.
  double reach = 1.6;
};

/// Learns words for colours and shapes from a few examples each, and finds the words that fit.
///
/// A word is an isotropic normal distribution. Its mean and width are estimated from the examples
/// and, for the width, a prior; predictions include the uncertainty of both. The order of the
/// examples does not matter.
class WordLearner {
public:
  explicit WordLearner(LearningOptions options = {}) : options_(options) {}

  /// Continues with the words of an earlier learner.
  /// \throws std::invalid_argument as problem_of() says.
  explicit WordLearner(std::vector<LearnedWord> words, LearningOptions options = {});

  /// Error message about a word; empty if it is valid.
  static std::string problem_of(const LearnedWord& word);

  /// Whether `kind` is a kind of words: "colour" or "shape".
  static bool is_kind(const std::string& kind);

  /// The evidence for words of that kind in a region's features; empty if there is none.
  static std::vector<double> evidence(const std::string& kind, const RegionFeatures& features);

  /// Learns from an example. Case is ignored.
  ///
  /// \param weight confidence of the example, in (0, 1].
  /// \throws std::invalid_argument for an unknown kind, a word that has blanks or `#` in it, is
  ///         empty or "unknown", evidence of the wrong length, or a weight out of range.
  void learn(const std::string& kind, const std::string& word, const std::vector<double>& evidence,
             double weight = 1);

  /// Hypotheses about the word for the evidence, the likeliest first, with "unknown" for none of
  /// them; confidences sum to 1.
  std::vector<Hypothesis> name(const std::string& kind, const std::vector<double>& evidence) const;

  /// Sorted by kind and word.
  const std::vector<LearnedWord>& words() const { return words_; }

private:
  LearningOptions options_;
  std::vector<LearnedWord> words_;
};

} // namespace castor::vision
