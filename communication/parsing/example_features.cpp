#include "castor/communication/parsing/example_features.hpp"

#include "castor/communication/parsing/stem.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

namespace castor::communication {

namespace {

using Feature = ExampleFeatures::Feature;
using Decisive = ExampleFeatures::Decisive;

/// Words that stand for something else.
constexpr auto things_said = "#things";
constexpr auto number_said = "#number";
constexpr auto side_said = "#side";
constexpr auto other_side_said = "#other-side";

/// Weights of pairs beside words of their own.
constexpr double neighbours = 0.7;
constexpr double with_one_between = 0.3;

/// Bits of features that are pairs; below are the numbers of their words.
constexpr Feature pair_bit = Feature{1} << 62U;
constexpr Feature between_bit = Feature{1} << 63U;
constexpr unsigned bits_of_word = 31;

/// What is left of the likeness for each decisive word, or negation, that only one of both has.
constexpr double without_decisive_word = 0.85;
constexpr double without_negation = 0.5;

/// And for any that only the utterance has.
constexpr double with_other_matter = 0.05;

/// Says nothing of what is meant.
bool says_nothing(std::string_view word) {
  return is_among(word, {",",    "a",     "an",    "the",    "some",   "please", "pls",
                         "thx",  "ta",    "ok",    "thanks", "cheers", "kindly", "just",
                         "now",  "then",  "so",    "well",   "really", "hey",    "hi",
                         "mate", "hello", "sorry", "oh",     "quick",  "quickly"});
}

/// Stems of words that make another matter of what is said.
constexpr std::array changing_words{
  "n't",  "not",     "never", "no",      "noth",      "nobodi",  "nowher", "none",
  "non",  "neither", "nor",   "without", "except",    "but",     "unless", "until",
  "till", "if",      "onli",  "instead", "avoid",     "opposit", "revers", "pretend",
  "half", "almost",  "near",  "bare",    "hard",      "mean",    "rather", "when",
  "than", "or",      "befor", "after",   "yesterday", "tomorrow"};

/// Stems of words that make another request or question of it.
constexpr std::array deciding_words{
  "front", "back", "behind", "centr", "middl", "edg",    "corner",  "colour",
  "color", "size", "height", "tall",  "shape", "off",    "between", "circl",
  "ring",  "row",  "line",   "stack", "tower", "togeth", "apart",   "top",
  "under", "how",  "what",   "which", "where", "whi",    "#side",   "#other-side"};

static_assert(changing_words.size() + deciding_words.size() <= Decisive{}.size());

/// The bits of the changing words come first.
std::optional<std::size_t> bit_of(std::string_view stem) {
  if (const auto changing = std::ranges::find(changing_words, stem);
      changing != changing_words.end())
    return static_cast<std::size_t>(changing - changing_words.begin());
  if (const auto deciding = std::ranges::find(deciding_words, stem);
      deciding != deciding_words.end())
    return changing_words.size() + static_cast<std::size_t>(deciding - deciding_words.begin());
  return std::nullopt;
}

/// Nothing for "right" that says how near something is: "right next to it", "right now".
std::string_view side_at(std::span<const ExamplePiece> pieces, std::size_t i) {
  const auto& word = pieces[i].words.front();
  const bool is_adverb =
    word == "right" && i + 1 < pieces.size() &&
    is_among(pieces[i + 1].words.front(),
             {"at", "by", "in", "next", "beside", "behind", "near", "there", "now", "away",
              "underneath", "under", "along", "up", "on", "that", "to"}) &&
    (i == 0 || !is_among(pieces[i - 1].words.front(), {"the", "to", "on", "from", "than"}));
  return pieces[i].names_things || is_adverb ? std::string_view{} : side_of(word);
}

/// \param number_of of a word's stem
template <class NumberOf>
ExampleFeatures features_of(std::span<const ExamplePiece> pieces, NumberOf number_of) {
  ExampleFeatures result;
  std::vector<Feature> words{number_of("<")};
  const auto add = [&](const std::string& stem) {
    words.push_back(number_of(stem));
    if (const auto bit = bit_of(stem))
      result.decisive.set(*bit);
  };
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& word = pieces[i].words.front();
    if (pieces[i].names_things) {
      ++result.things;
      add(things_said);
    } else if (const auto side = side_at(pieces, i); !side.empty()) {
      if (result.side.empty())
        result.side = side;
      add(side == result.side ? side_said : other_side_said);
    } else if (is_number_word(word)) {
      ++result.numbers;
      add(number_said);
    } else if (!says_nothing(word))
      add(stem_of(word));
  }
  words.push_back(number_of(">"));
  auto& counts = result.counts;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0 && i + 1 < words.size())
      counts.emplace_back(words[i], 1);
    if (i + 1 < words.size())
      counts.emplace_back(pair_bit | words[i] << bits_of_word | words[i + 1], neighbours);
    if (i + 2 < words.size())
      counts.emplace_back(pair_bit | between_bit | words[i] << bits_of_word | words[i + 2],
                          with_one_between);
  }
  std::ranges::sort(counts);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (kept > 0 && counts[kept - 1].first == counts[i].first)
      counts[kept - 1].second += counts[i].second;
    else
      counts[kept++] = counts[i];
  counts.resize(kept);
  // A word that is said twice is not twice as much of what is meant.
  for (auto& [feature, count] : counts)
    if (!ExampleFeatures::is_pair(feature))
      count = std::sqrt(count);
  return result;
}

} // namespace

bool ExampleFeatures::is_pair(Feature feature) {
  return (feature & pair_bit) != 0;
}

double kept_likeness(const Decisive& said, const Decisive& example) {
  static const auto changing = ~(~Decisive{} << changing_words.size());
  const auto more = said & ~example;
  if ((more & changing).any())
    return with_other_matter;
  const auto less = example & ~said;
  const auto negations = (less & changing).count();
  return std::pow(without_negation, negations) *
         std::pow(without_decisive_word, more.count() + less.count() - negations);
}

std::string_view side_of(std::string_view word) {
  for (const std::string_view side : {"left", "right"})
    if (word.starts_with(side) &&
        is_among(word.substr(side.size()), {"", "ward", "wards", "hand", "most"}))
      return side;
  return {};
}

std::string_view side_in(std::span<const ExamplePiece> pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (const auto side = side_at(pieces, i); !side.empty())
      return side;
  return {};
}

bool is_number_word(std::string_view word) {
  return std::isdigit(static_cast<unsigned char>(word.front())) != 0 ||
         is_among(word, {"two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
                         "fifteen", "twenty"});
}

bool says_something(std::span<const ExamplePiece> pieces) {
  return std::ranges::any_of(
    pieces, [](const auto& x) { return x.names_things || !says_nothing(x.words.front()); });
}

ExampleFeatures ExampleFeatureReader::learn(std::span<const ExamplePiece> pieces) {
  return features_of(pieces, [&](const std::string& stem) {
    return Feature{
      words_.try_emplace(stem, static_cast<std::uint32_t>(words_.size())).first->second};
  });
}

ExampleFeatures ExampleFeatureReader::read(std::span<const ExamplePiece> pieces) const {
  std::vector<std::string> unknown;
  return features_of(pieces, [&](const std::string& stem) {
    if (const auto known = words_.find(stem); known != words_.end())
      return Feature{known->second};
    const auto same = std::ranges::find(unknown, stem) - unknown.begin();
    if (static_cast<std::size_t>(same) == unknown.size())
      unknown.push_back(stem);
    return Feature{words_.size() + static_cast<std::size_t>(same)};
  });
}

} // namespace castor::communication
