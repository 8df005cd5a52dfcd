#include "castor/communication/parsing/examples.hpp"

#include "castor/communication/parsing/stem.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cctype>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace castor::communication {

namespace {

/// Features of what stands for something else.
constexpr std::string_view things_said = "#things";
constexpr std::string_view number_said = "#number";
constexpr std::string_view side_said = "#side";
constexpr std::string_view other_side_said = "#other-side";

/// Weights of pairs beside words of their own.
constexpr double neighbours = 0.7;
constexpr double with_one_between = 0.3;

/// What is left of the likeness for each decisive word, or negation, that only one of both has.
constexpr double without_decisive_word = 0.85;
constexpr double without_negation = 0.5;

/// So much of the likeness is that to further sentences of the same meaning.
constexpr double share_of_others = 0.13;
constexpr std::size_t others = 3;

bool is_slot_word(std::string_view word) {
  return is_among(word, {"x", "y", "z"});
}

/// "Left" or "right"; empty for what is neither.
std::string_view side_of(std::string_view word) {
  for (const auto* side : {"left", "right"})
    for (const auto* end : {"", "ward", "wards", "hand", "most"})
      if (word == std::string{side} + end)
        return side;
  return {};
}

bool is_number(std::string_view word) {
  return std::isdigit(static_cast<unsigned char>(word.front())) != 0 ||
         is_among(word, {"two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
                         "fifteen", "twenty"});
}

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

using Bits = std::bitset<128>;
static_assert(changing_words.size() + deciding_words.size() <= Bits{}.size());

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

/// What is left of the likeness to an example; nothing if what is said is another matter.
double kept(const Bits& said, const Bits& example) {
  static const auto changing = ~(~Bits{} << changing_words.size());
  const auto more = said & ~example;
  if ((more & changing).any())
    return 0;
  const auto less = example & ~said;
  const auto negations = (less & changing).count();
  return std::pow(without_negation, negations) *
         std::pow(without_decisive_word, more.count() + less.count() - negations);
}

std::vector<ExamplePiece> pieces_of(std::string_view text) {
  std::vector<ExamplePiece> result;
  for (auto& word : words_of(text)) {
    const bool is_thing = is_slot_word(word);
    result.push_back({{std::move(word)}, is_thing});
  }
  return result;
}

std::vector<std::string> slots_of(std::span<const ExamplePiece> pieces) {
  std::vector<std::string> result;
  for (const auto& piece : pieces)
    if (piece.names_things)
      result.push_back(piece.words.front());
  return result;
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
  return is_adverb ? std::string_view{} : side_of(word);
}

std::vector<std::vector<std::string>> things_in(std::span<const ExamplePiece> pieces) {
  std::vector<std::vector<std::string>> result;
  for (const auto& piece : pieces)
    if (piece.names_things)
      result.push_back(piece.words);
  return result;
}

/// Whether the same is said where the slots are the same.
bool have_same_things(const std::vector<std::string>& slots,
                      const std::vector<std::vector<std::string>>& things) {
  for (std::size_t i = 0; i < slots.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (slots[i] == slots[j] && things[i] != things[j])
        return false;
  return true;
}

} // namespace

Examples::Said Examples::said_in(std::span<const ExamplePiece> pieces) {
  Said result;
  Words features{"<"};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& word = pieces[i].words.front();
    if (pieces[i].names_things) {
      ++result.things;
      features.emplace_back(things_said);
    } else if (const auto side = side_at(pieces, i); !side.empty()) {
      if (result.side.empty())
        result.side = side;
      features.emplace_back(side == result.side ? side_said : other_side_said);
    } else if (is_number(word)) {
      ++result.numbers;
      features.emplace_back(number_said);
    } else if (!says_nothing(word))
      features.push_back(stem_of(word));
  }
  features.emplace_back(">");
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (i > 0 && i + 1 < features.size()) {
      ++result.counts[features[i]];
      if (const auto bit = bit_of(features[i]))
        result.decisive.set(*bit);
    }
    if (i + 1 < features.size())
      result.counts[features[i] + ' ' + features[i + 1]] += neighbours;
    if (i + 2 < features.size())
      result.counts[features[i] + " * " + features[i + 2]] += with_one_between;
  }
  // A word that is said twice is not twice as much of what is meant.
  for (auto& [feature, count] : result.counts)
    if (feature.find(' ') == std::string::npos)
      count = std::sqrt(count);
  return result;
}

void Examples::add(std::string_view meaning, std::string_view sentence) {
  const auto means = words_of(meaning);
  const auto pieces = pieces_of(sentence);
  auto slots = slots_of(pieces);
  const auto needed = slots_of(pieces_of(meaning));
  const auto name_of = [](const std::string& slot) {
    return std::string(1, static_cast<char>(std::toupper(slot.front())));
  };
  for (const auto& slot : needed)
    if (std::ranges::find(slots, slot) == slots.end())
      throw std::invalid_argument{"it does not have " + name_of(slot) + " of its meaning"};
  for (const auto& slot : slots)
    if (std::ranges::find(needed, slot) == needed.end())
      throw std::invalid_argument{"its meaning does not have " + name_of(slot)};
  auto said = said_in(pieces);
  const bool has_side = !said_in(pieces_of(meaning)).side.empty();
  if (has_side && said.side.empty())
    throw std::invalid_argument{"it does not say left or right, as its meaning does"};
  if (said.counts.size() < 2)
    throw std::invalid_argument{"it says nothing"};
  if (meanings_.empty() || meanings_.back() != means)
    meanings_.push_back(means);
  for (const auto& piece : pieces)
    if (!piece.names_things)
      words_[piece.words.front()].insert(meanings_.size() - 1);
  examples_.push_back({meanings_.size() - 1, std::move(said), std::move(slots), has_side});
}

bool Examples::has_common_word(const std::string& word) const {
  const auto known = words_.find(word);
  return known != words_.end() && known->second.size() > 2;
}

void Examples::weigh() {
  spread_.clear();
  index_.clear();
  // The examples of a meaning follow each other.
  std::unordered_map<std::string_view, std::size_t> last;
  for (const auto& example : examples_)
    for (const auto& [feature, count] : example.said.counts)
      if (const auto [known, is_new] = last.emplace(feature, example.meaning);
          is_new || std::exchange(known->second, example.meaning) != example.meaning)
        ++spread_[feature];
  for (std::size_t i = 0; i < examples_.size(); ++i) {
    std::vector<double> weights;
    double square = 0;
    for (const auto& [feature, count] : examples_[i].said.counts) {
      weights.push_back(count * weight_of(feature));
      square += weights.back() * weights.back();
    }
    auto weight = weights.begin();
    for (const auto& [feature, count] : examples_[i].said.counts)
      index_[feature].push_back({i, *weight++ / std::sqrt(square)});
  }
}

double Examples::weight_of(const std::string& feature) const {
  const auto spread = spread_.find(feature);
  const auto all = static_cast<double>(meanings_.size());
  if (spread != spread_.end())
    return std::log1p(all / static_cast<double>(spread->second));
  // A pair is often not known though its words are.
  return std::log1p(all) * (feature.find(' ') == std::string::npos ? 1 : 0.5);
}

std::vector<Examples::Match> Examples::nearest(std::span<const ExamplePiece> pieces,
                                               std::size_t most) const {
  const auto said = said_in(pieces);
  std::vector<double> common(examples_.size());
  double square = 0;
  for (const auto& [feature, count] : said.counts) {
    const auto weight = count * weight_of(feature);
    square += weight * weight;
    if (const auto shares = index_.find(feature); shares != index_.end())
      for (const auto& share : shares->second)
        common[share.example] += weight * share.weight;
  }
  struct Candidate {
    double likeness = 0;
    std::size_t example = 0;
  };
  const auto things = things_in(pieces);
  std::map<std::size_t, std::vector<Candidate>> by_meaning;
  for (std::size_t i = 0; i < examples_.size(); ++i) {
    const auto& example = examples_[i];
    if (common[i] <= 0 || example.said.things != said.things ||
        example.said.numbers != said.numbers || (example.has_side && said.side.empty()) ||
        !have_same_things(example.slots, things))
      continue;
    auto likeness = common[i] / std::sqrt(square);
    likeness *= kept(said.decisive, example.said.decisive);
    if (likeness <= 0)
      continue;
    by_meaning[example.meaning].push_back({likeness, i});
  }
  std::vector<Candidate> best;
  for (auto& [meaning, candidates] : by_meaning) {
    const auto count = std::min(candidates.size(), others + 1);
    std::ranges::partial_sort(candidates,
                              std::next(candidates.begin(), static_cast<std::ptrdiff_t>(count)),
                              std::ranges::greater{}, &Candidate::likeness);
    const auto further =
      std::accumulate(std::next(candidates.begin()),
                      std::next(candidates.begin(), static_cast<std::ptrdiff_t>(count)), 0.0,
                      [](double sum, const Candidate& x) { return sum + x.likeness; });
    best.push_back({(1 - share_of_others) * candidates.front().likeness +
                      share_of_others * further / static_cast<double>(others),
                    candidates.front().example});
  }
  std::ranges::stable_sort(best, std::ranges::greater{}, &Candidate::likeness);
  best.resize(std::min(best.size(), most));
  std::vector<Match> result;
  for (const auto& x : best)
    result.push_back({filled(examples_[x.example], said, pieces), x.likeness});
  return result;
}

Examples::Words Examples::filled(const Example& example, const Said& said,
                                 std::span<const ExamplePiece> pieces) const {
  const auto things = things_in(pieces);
  const auto number = std::ranges::find_if(
    pieces, [](const auto& x) { return !x.names_things && is_number(x.words.front()); });
  const bool is_mirrored = !said.side.empty() && said.side != example.said.side;
  Words result;
  for (const auto& word : meanings_[example.meaning])
    if (is_slot_word(word)) {
      const auto slot = std::ranges::find(example.slots, word) - example.slots.begin();
      const auto& thing = things[static_cast<std::size_t>(slot)];
      result.insert(result.end(), thing.begin(), thing.end());
    } else if (is_mirrored && !side_of(word).empty())
      result.emplace_back(word == "left" ? "right" : "left");
    else if (is_number(word) && number != pieces.end())
      result.push_back(number->words.front());
    else
      result.push_back(word);
  return result;
}

} // namespace castor::communication
