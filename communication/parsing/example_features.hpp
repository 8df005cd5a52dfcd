#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor::communication {

/// A word of an utterance, or several that name things.
struct ExamplePiece {
  std::vector<std::string> words;
  bool names_things = false;
};

/// What sentences are compared by.
struct ExampleFeatures {
  /// A word, two neighbours, or two words with one between.
  using Feature = std::uint64_t;

  /// A bit for each of a list of words.
  using Decisive = std::bitset<128>;

  /// How often each is said, by increasing feature; pairs count less.
  std::vector<std::pair<Feature, double>> counts;
  /// Which of the words are said that make another request or question of it: "not", "left".
  Decisive decisive;
  std::size_t things = 0;
  std::size_t numbers = 0;
  /// The first of "left" and "right"; empty if there is none.
  std::string side;

  static bool is_pair(Feature feature);
};

/// What is left of the likeness to an example; little if what is said is another matter.
double kept_likeness(const ExampleFeatures::Decisive& said,
                     const ExampleFeatures::Decisive& example);

/// "Left" or "right"; empty for what is neither.
std::string_view side_of(std::string_view word);

/// The first of "left" and "right" in it, other than in "right next to it".
std::string_view side_in(std::span<const ExamplePiece> pieces);

bool is_number_word(std::string_view word);

/// Whether there is anything in it that says what is meant.
bool says_something(std::span<const ExamplePiece> pieces);

/// Numbers the words of examples, by their stems, as they come.
class ExampleFeatureReader {
public:
  /// Of an example.
  ExampleFeatures learn(std::span<const ExamplePiece> pieces);

  /// Of what may have words that no example has.
  ExampleFeatures read(std::span<const ExamplePiece> pieces) const;

private:
  std::unordered_map<std::string, std::uint32_t> words_;
};

} // namespace castor::communication
