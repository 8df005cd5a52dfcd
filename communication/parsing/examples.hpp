#pragma once

#include "castor/communication/parsing/example_features.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

/// Sentences that people say, each with what it means in words of the grammar:
///
///     put X to the left of Y       the meaning
///       X belongs on Y's left      sentences that mean it
///
/// X, Y and Z stand for words that name things, "left" and "right" for each other on both sides,
/// and a number for another number. Sentences of a meaning without them may name any things: those
/// of "that is a remark" ask for nothing.
///
/// What an utterance means is learned from the examples (LinearClassifier) by its words, its pairs
/// of neighbours and its pairs with one word between, words by their stems. How like it is to the
/// examples of a meaning is the cosine of vectors of the same, which weigh the more, the fewer
/// meanings have them.
class Examples {
public:
  struct Match {
    /// With what the utterance says in place of what the example says.
    std::vector<std::string> meaning;
    /// 1 if sentences of this meaning are the same as the utterance, 0 if they have nothing in
    /// common with it.
    double likeness = 0;
    /// By the classifier's scores: twice that of this meaning, less that of the likeliest other.
    double certainty = 0;
  };

  Examples();

  /// \throws std::invalid_argument what is wrong with them
  void add(std::string_view meaning, std::string_view sentence);

  /// The most certain first, each meaning once. The first question after an addition learns from all
  /// examples: some tenths of a second for those of the lexicon.
  std::vector<Match> likeliest(std::span<const ExamplePiece> said, std::size_t most) const;

  /// As in Match; 0 if there are no examples of this meaning.
  double certainty_of(std::string_view meaning, std::span<const ExamplePiece> said) const;

  /// Whether any sentence has this word.
  bool has_word(const std::string& word) const;

  /// Whether sentences of several meanings have this word: it is none that only names things.
  bool has_common_word(const std::string& word) const;

  std::size_t size() const { return examples_.size(); }

private:
  using Words = std::vector<std::string>;

  struct Example {
    std::size_t meaning = 0;
    std::string sentence;
  };

  /// What is learned from all of them, once it is asked for.
  class Learned;

  std::size_t number_of_meaning(const Words& meaning);
  const Learned& learned() const;

  std::vector<Words> meanings_;
  std::vector<Example> examples_;
  /// Shared with copies, which have the same examples; a new one for each that is added.
  std::shared_ptr<Learned> learned_;
};

} // namespace castor::communication
