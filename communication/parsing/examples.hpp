#pragma once

#include <bitset>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace castor::communication {

/// A word of an utterance, or several that name things.
struct ExamplePiece {
  std::vector<std::string> words;
  bool names_things = false;
};

/// Sentences that people say, each with what it means in words of the grammar:
///
///     put X to the left of Y       the meaning
///       X belongs on Y's left      sentences that mean it
///
/// X, Y and Z stand for words that name things, "left" and "right" for each other on both sides,
/// and a number for another number.
///
/// What an utterance is most like is found by its words, its pairs of neighbours and its pairs with
/// one word between, which weigh the more, the fewer meanings have them in their sentences (cosine
/// of the weighted vectors; words by their stems).
class Examples {
public:
  struct Match {
    /// With what the utterance says in place of what the example says.
    std::vector<std::string> meaning;
    /// 1 if sentences of this meaning are the same as the utterance, 0 if they have nothing in
    /// common with it.
    double likeness = 0;
  };

  /// \throws std::invalid_argument what is wrong with them
  void add(std::string_view meaning, std::string_view sentence);

  /// Weighs words by how many meanings have them; to be called after the last one is added.
  void weigh();

  /// The nearest first, each meaning once.
  std::vector<Match> nearest(std::span<const ExamplePiece> said, std::size_t most) const;

  /// Whether sentences of several meanings have this word: it is none that only names things.
  bool has_common_word(const std::string& word) const;

  std::size_t size() const { return examples_.size(); }

private:
  using Words = std::vector<std::string>;

  /// How often something is said, by what is said.
  using Counts = std::map<std::string, double>;

  /// A bit for each of a list of words.
  using Decisive = std::bitset<128>;

  /// What examples and utterances are compared by.
  struct Said {
    Counts counts;
    /// Which of the words are said that make another request or question of it: "not", "left".
    Decisive decisive;
    std::size_t things = 0;
    std::size_t numbers = 0;
    /// The first of "left" and "right"; empty if there is none.
    std::string side;
  };

  struct Example {
    std::size_t meaning = 0;
    Said said;
    /// The slots, in the order in which they are said.
    Words slots;
    /// Whether its meaning says "left" or "right".
    bool has_side = false;
  };

  /// Of an example: how much of its direction is along this feature.
  struct Share {
    std::size_t example = 0;
    double weight = 0;
  };

  static Said said_in(std::span<const ExamplePiece> pieces);
  double weight_of(const std::string& feature) const;
  Words filled(const Example& example, const Said& said,
               std::span<const ExamplePiece> pieces) const;

  std::vector<Words> meanings_;
  std::vector<Example> examples_;
  /// The meanings of whose sentences a word is part.
  std::unordered_map<std::string, std::set<std::size_t>> words_;
  std::unordered_map<std::string, std::vector<Share>> index_;
  /// By how many meanings a feature is said.
  std::unordered_map<std::string, std::size_t> spread_;
};

} // namespace castor::communication
