#include "castor/communication/parsing/examples.hpp"

#include "castor/communication/parsing/linear_classifier.hpp"
#include "castor/communication/parsing/tokens.hpp"
#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace castor::communication {

namespace {

using Words = std::vector<std::string>;
using Things = std::vector<Words>;
using Feature = ExampleFeatures::Feature;

/// In how many examples a pair has to be to be learned from.
constexpr std::size_t least_often = 2;

/// So much of the likeness is that to further sentences of the same meaning.
constexpr double share_of_others = 0.13;
constexpr std::size_t others = 3;

/// Of the classifier, where nothing speaks for a meaning.
constexpr float least_score = -1;

bool is_slot_word(std::string_view word) {
  return is_among(word, {"x", "y", "z"});
}

std::vector<ExamplePiece> pieces_of(std::string_view text) {
  std::vector<ExamplePiece> result;
  for (auto& word : words_of(text)) {
    const bool is_thing = is_slot_word(word);
    result.push_back({{std::move(word)}, is_thing});
  }
  return result;
}

Words slots_of(std::span<const ExamplePiece> pieces) {
  Words result;
  for (const auto& piece : pieces)
    if (piece.names_things)
      result.push_back(piece.words.front());
  return result;
}

Things things_in(std::span<const ExamplePiece> pieces) {
  Things result;
  for (const auto& piece : pieces)
    if (piece.names_things)
      result.push_back(piece.words);
  return result;
}

/// Whether the same is said where the slots are the same.
bool have_same_things(const Words& slots, const Things& things) {
  for (std::size_t i = 0; i < slots.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (slots[i] == slots[j] && things[i] != things[j])
        return false;
  return true;
}

} // namespace

class Examples::Learned {
public:
  void learn(const std::vector<Words>& meanings, std::span<const Example> examples) {
    std::call_once(once_, [&] {
      meanings_ = meanings;
      for (const auto& meaning : meanings_)
        have_side_.push_back(!side_in(pieces_of_words(meaning)).empty());
      for (const auto& example : examples)
        read(example);
      weigh();
      train();
    });
  }

  std::vector<Match> likeliest(std::span<const ExamplePiece> pieces, std::size_t most) const;

  double certainty_of(const Words& meaning, std::span<const ExamplePiece> pieces) const {
    const auto known = std::ranges::find(meanings_, meaning);
    return known == meanings_.end()
             ? 0
             : certainties(
                 reader_.read(pieces))[static_cast<std::size_t>(known - meanings_.begin())];
  }

  bool has_word(const std::string& word) const { return words_.contains(word); }

  bool has_common_word(const std::string& word) const {
    const auto known = words_.find(word);
    return known != words_.end() && known->second.size() > 2;
  }

private:
  struct Read {
    std::size_t meaning = 0;
    ExampleFeatures features;
    /// In the order in which they are said.
    Words slots;
  };

  /// Of an example: how much of its direction is along a feature.
  struct Share {
    std::uint32_t example = 0;
    float weight = 0;
  };

  struct Candidate {
    double likeness = 0;
    std::size_t example = 0;
    double certainty = 0;
  };

  static std::vector<ExamplePiece> pieces_of_words(const Words& words) {
    std::vector<ExamplePiece> result;
    for (const auto& word : words)
      result.push_back({{word}, is_slot_word(word)});
    return result;
  }

  void read(const Example& example) {
    const auto pieces = pieces_of(example.sentence);
    examples_.push_back({example.meaning, reader_.learn(pieces), slots_of(pieces)});
    for (const auto& piece : pieces)
      if (!piece.names_things)
        words_[piece.words.front()].insert(example.meaning);
  }

  /// Features by how many meanings have them.
  void weigh() {
    struct Spread {
      std::size_t meanings = 0;
      std::size_t last = 0;
    };
    std::unordered_map<Feature, Spread> spreads;
    std::ranges::stable_sort(examples_, {}, &Read::meaning);
    for (const auto& example : examples_)
      for (const auto& [feature, count] : example.features.counts)
        if (auto& spread = spreads[feature]; spread.meanings == 0 || spread.last != example.meaning)
          spread = {spread.meanings + 1, example.meaning};
    for (const auto& [feature, spread] : spreads)
      weights_[feature] =
        std::log1p(static_cast<double>(meanings_.size()) / static_cast<double>(spread.meanings));
    for (std::size_t i = 0; i < examples_.size(); ++i) {
      double square = 0;
      for (const auto& [feature, count] : examples_[i].features.counts)
        square += std::pow(count * weight_of(feature), 2);
      for (const auto& [feature, count] : examples_[i].features.counts)
        index_[feature].push_back(
          {static_cast<std::uint32_t>(i),
           static_cast<float>(count * weight_of(feature) / std::sqrt(square))});
    }
  }

  double weight_of(Feature feature) const {
    if (const auto known = weights_.find(feature); known != weights_.end())
      return known->second;
    // A pair is often not known though its words are.
    return std::log1p(static_cast<double>(meanings_.size())) *
           (ExampleFeatures::is_pair(feature) ? 0.5 : 1);
  }

  void train() {
    std::unordered_map<Feature, std::size_t> often;
    for (const auto& example : examples_)
      for (const auto& [feature, count] : example.features.counts)
        if (++often[feature] == (ExampleFeatures::is_pair(feature) ? least_often : 1))
          numbers_.emplace(feature, numbers_.size());
    std::vector<LinearClassifier::Sample> samples;
    for (const auto& example : examples_)
      samples.push_back({vector_of(example.features), example.meaning});
    classifier_.emplace(samples, numbers_.size(), meanings_.size());
    // They are not compared by these, but by the index.
    for (auto& example : examples_)
      example.features.counts = {};
  }

  /// Part of a vector of length 1: the more is not known, the less certain is the rest.
  LinearClassifier::Features vector_of(const ExampleFeatures& said) const {
    double square = 0;
    for (const auto& [feature, count] : said.counts)
      square += count * count;
    LinearClassifier::Features result;
    for (const auto& [feature, count] : said.counts)
      if (const auto known = numbers_.find(feature); known != numbers_.end())
        result.push_back({known->second, static_cast<float>(count / std::sqrt(square))});
    return result;
  }

  /// Of each meaning.
  std::vector<double> certainties(const ExampleFeatures& said) const {
    const auto scores = classifier_->scores(vector_of(said));
    auto best = least_score;
    auto second = least_score;
    for (const auto score : scores) {
      second = std::max(second, std::min(score, best));
      best = std::max(best, score);
    }
    std::vector<double> result;
    for (const auto score : scores)
      result.push_back(2 * score - (score == best ? second : best));
    return result;
  }

  std::map<std::size_t, std::vector<Candidate>> candidates(const ExampleFeatures& said,
                                                           const Things& things) const;
  Words filled(const Read& example, const ExampleFeatures& said,
               std::span<const ExamplePiece> pieces) const;

  std::once_flag once_;
  std::vector<Words> meanings_;
  /// Whether a meaning says "left" or "right".
  std::vector<bool> have_side_;
  ExampleFeatureReader reader_;
  std::vector<Read> examples_;
  /// The meanings of whose sentences a word is part.
  std::unordered_map<std::string, std::set<std::size_t>> words_;
  std::unordered_map<Feature, double> weights_;
  std::unordered_map<Feature, std::vector<Share>> index_;
  /// Of the features that are learned from.
  std::unordered_map<Feature, std::size_t> numbers_;
  std::optional<LinearClassifier> classifier_;
};

/// Of each meaning, the examples that may stand for what is said.
std::map<std::size_t, std::vector<Examples::Learned::Candidate>>
Examples::Learned::candidates(const ExampleFeatures& said, const Things& things) const {
  std::vector<double> common(examples_.size());
  double square = 0;
  for (const auto& [feature, count] : said.counts) {
    const auto weight = count * weight_of(feature);
    square += weight * weight;
    if (const auto shares = index_.find(feature); shares != index_.end())
      for (const auto& share : shares->second)
        common[share.example] += weight * share.weight;
  }
  std::map<std::size_t, std::vector<Candidate>> result;
  for (std::size_t i = 0; i < examples_.size(); ++i) {
    const auto& example = examples_[i];
    if (common[i] <= 0 || example.features.things != said.things ||
        example.features.numbers != said.numbers ||
        (have_side_[example.meaning] && said.side.empty()) ||
        !have_same_things(example.slots, things))
      continue;
    const auto likeness =
      common[i] / std::sqrt(square) * kept_likeness(said.decisive, example.features.decisive);
    result[example.meaning].push_back({likeness, i});
  }
  return result;
}

std::vector<Examples::Match> Examples::Learned::likeliest(std::span<const ExamplePiece> pieces,
                                                          std::size_t most) const {
  const auto said = reader_.read(pieces);
  auto by_meaning = candidates(said, things_in(pieces));
  if (by_meaning.empty())
    return {};
  const auto certainty = certainties(said);
  std::vector<Candidate> best;
  for (auto& [meaning, all] : by_meaning) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(all.size(), others + 1));
    std::ranges::partial_sort(all, std::next(all.begin(), count), std::ranges::greater{},
                              &Candidate::likeness);
    const auto further =
      std::accumulate(std::next(all.begin()), std::next(all.begin(), count), 0.0,
                      [](double sum, const Candidate& x) { return sum + x.likeness; });
    best.push_back({(1 - share_of_others) * all.front().likeness +
                      share_of_others * further / static_cast<double>(others),
                    all.front().example, certainty[meaning]});
  }
  std::ranges::stable_sort(best, std::ranges::greater{}, &Candidate::certainty);
  best.resize(std::min(best.size(), most));
  std::vector<Match> result;
  for (const auto& x : best)
    result.push_back({filled(examples_[x.example], said, pieces), x.likeness, x.certainty});
  return result;
}

Words Examples::Learned::filled(const Read& example, const ExampleFeatures& said,
                                std::span<const ExamplePiece> pieces) const {
  const auto things = things_in(pieces);
  const auto number = std::ranges::find_if(
    pieces, [](const auto& x) { return !x.names_things && is_number_word(x.words.front()); });
  const bool is_mirrored = !said.side.empty() && said.side != example.features.side;
  Words result;
  for (const auto& word : meanings_[example.meaning])
    if (is_slot_word(word)) {
      const auto slot = std::ranges::find(example.slots, word) - example.slots.begin();
      const auto& thing = things[static_cast<std::size_t>(slot)];
      result.insert(result.end(), thing.begin(), thing.end());
    } else if (is_mirrored && !side_of(word).empty())
      result.emplace_back(word == "left" ? "right" : "left");
    else if (is_number_word(word) && number != pieces.end())
      result.push_back(number->words.front());
    else
      result.push_back(word);
  return result;
}

Examples::Examples() : learned_(std::make_shared<Learned>()) {}

std::size_t Examples::number_of_meaning(const Words& meaning) {
  // The examples of a meaning mostly follow each other.
  const auto known = !meanings_.empty() && meanings_.back() == meaning
                       ? std::prev(meanings_.end())
                       : std::ranges::find(meanings_, meaning);
  if (known == meanings_.end()) {
    meanings_.push_back(meaning);
    return meanings_.size() - 1;
  }
  return static_cast<std::size_t>(known - meanings_.begin());
}

void Examples::add(std::string_view meaning, std::string_view sentence) {
  const auto means = words_of(meaning);
  const auto meaning_pieces = pieces_of(meaning);
  const auto pieces = pieces_of(sentence);
  const auto slots = slots_of(pieces);
  const auto needed = slots_of(meaning_pieces);
  const auto name_of = [](const std::string& slot) {
    return std::string(1, static_cast<char>(std::toupper(slot.front())));
  };
  for (const auto& slot : needed)
    if (std::ranges::find(slots, slot) == slots.end())
      throw std::invalid_argument{"it does not have " + name_of(slot) + " of its meaning"};
  for (const auto& slot : slots)
    if (!needed.empty() && std::ranges::find(needed, slot) == needed.end())
      throw std::invalid_argument{"its meaning does not have " + name_of(slot)};
  if (!side_in(meaning_pieces).empty() && side_in(pieces).empty())
    throw std::invalid_argument{"it does not say left or right, as its meaning does"};
  if (!says_something(pieces))
    throw std::invalid_argument{"it says nothing"};
  examples_.push_back({number_of_meaning(means), std::string{sentence}});
  learned_ = std::make_shared<Learned>();
}

const Examples::Learned& Examples::learned() const {
  learned_->learn(meanings_, examples_);
  return *learned_;
}

std::vector<Examples::Match> Examples::likeliest(std::span<const ExamplePiece> said,
                                                 std::size_t most) const {
  return learned().likeliest(said, most);
}

double Examples::certainty_of(std::string_view meaning, std::span<const ExamplePiece> said) const {
  return learned().certainty_of(words_of(meaning), said);
}

bool Examples::has_word(const std::string& word) const {
  return learned().has_word(word);
}

bool Examples::has_common_word(const std::string& word) const {
  return learned().has_common_word(word);
}

} // namespace castor::communication
