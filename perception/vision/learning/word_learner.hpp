#pragma once

#include "castor/perception/vision/types.hpp"

#include <string>
#include <vector>

namespace castor::vision {

struct LearningOptions {
  /// How far the evidence of things that are called the same spreads about its mean, as long as
  /// examples say nothing else: the standard deviation along each axis. Of colours in L*a*b* units,
  /// of shapes in hidden values of the shape network.
  double colour_spread = 6;
  double shape_spread = 0.3;
  /// This counts as much as so many examples.
  double prior_examples = 3;
  /// Evidence that is further from a word's mean than this is nothing that the word is for: in
  /// standard deviations along each axis, root mean square.
  double reach = 1.6;
};

/// Learns words for colours and shapes from a few examples each, and says which fit.
///
/// A word is a normal distribution of the same width in all directions, of which mean and width are
/// estimated from the examples and, for the width, a prior; what it says of something new allows
/// for the uncertainty of both. The order of the examples does not matter.
class WordLearner {
public:
  explicit WordLearner(LearningOptions options = {}) : options_(options) {}

  /// Goes on with what another has learned.
  /// \throws std::invalid_argument as problem_of() says.
  explicit WordLearner(std::vector<LearnedWord> words, LearningOptions options = {});

  /// What is wrong with a word, for people; empty if nothing is.
  static std::string problem_of(const LearnedWord& word);

  /// Whether there are words of this kind: "colour" or "shape".
  static bool is_kind(const std::string& kind);

  /// The evidence for words of that kind in a region's features; empty if there is none.
  static std::vector<double> evidence(const std::string& kind, const RegionFeatures& features);

  /// Takes in an example. Capital letters do not matter.
  ///
  /// \param weight how sure it is, in (0, 1].
  /// \throws std::invalid_argument for an unknown kind, a word that has blanks or `#` in it, is
  ///         empty or "unknown", evidence of the wrong length, or a weight out of range.
  void learn(const std::string& kind, const std::string& word, const std::vector<double>& evidence,
             double weight = 1);

  /// The words that may be for it, the likeliest first, with "unknown" for that none is;
  /// confidences sum to 1.
  std::vector<Hypothesis> name(const std::string& kind, const std::vector<double>& evidence) const;

  /// By kind and word.
  const std::vector<LearnedWord>& words() const { return words_; }

private:
  LearningOptions options_;
  std::vector<LearnedWord> words_;
};

} // namespace castor::vision
