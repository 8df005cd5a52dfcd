#include "castor/communication/parsing/lexicon.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/communication/parsing/numerals.hpp"
#include "castor/communication/parsing/tokens.hpp"

#include <algorithm>
#include <sstream>
#include <tuple>

namespace castor::communication {

namespace {

/// So many letters are in both words, wherever they stand.
std::size_t common_letters(std::string_view a, std::string_view b) {
  std::size_t count = 0;
  std::string rest(b);
  for (const char letter : a)
    if (const auto place = rest.find(letter); place != std::string::npos) {
      rest.erase(place, 1);
      ++count;
    }
  return count;
}

} // namespace

bool is_quoted(std::string_view word) {
  return word.size() > 2 && word.front() == '\'' && word.back() == '\'';
}

void Lexicon::add(LexicalEntry entry) {
  const auto number = static_cast<std::uint32_t>(entries_.size());
  auto& same_phrase = phrases_[entry.phrase];
  if (std::ranges::any_of(same_phrase, [&](auto other) { return entries_[other] == entry; }))
    return;
  same_phrase.push_back(number);
  add_words_of(entry.phrase);
  entries_.push_back(std::move(entry));
}

void Lexicon::add_filler(const std::string& phrase, double weight) {
  fillers_[phrase] = weight;
  add_words_of(phrase);
}

void Lexicon::add_words_of(const std::string& phrase) {
  std::istringstream in(phrase);
  std::size_t length = 0;
  Word* last = nullptr;
  for (std::string word; in >> word; ++length) {
    last = &words_[word];
    ++last->entries;
  }
  if (last != nullptr)
    last->longest_phrase = std::max(last->longest_phrase, length);
}

std::size_t Lexicon::longest_phrase_ending_in(const std::string& word) const {
  const auto longest = [this](const std::string& last) {
    const auto known = words_.find(last);
    return known == words_.end() ? 1 : known->second.longest_phrase;
  };
  return is_numeral(word) ? std::max(longest(word), longest(std::string(any_numeral)))
                          : longest(word);
}

void Lexicon::add_to(WordClass word_class, const std::string& phrase) {
  classes_.emplace(word_class, phrase);
  std::istringstream in(phrase);
  std::size_t length = 0;
  for (std::string word; in >> word; ++length)
    class_words_.insert(word);
  if (word_class == WordClass::aside)
    longest_aside_ = std::max(longest_aside_, length);
}

void Lexicon::add_paraphrase(Paraphrase paraphrase, bool is_always) {
  class_words_.insert(paraphrase.words().begin(), paraphrase.words().end());
  (is_always ? always_paraphrases_ : paraphrases_).push_back(std::move(paraphrase));
}

void Lexicon::add_example(std::string_view meaning, std::string_view sentence) {
  examples_.add(meaning, sentence);
  for (const auto& word : words_of(sentence))
    ++example_words_[word];
}

bool Lexicon::is_in_a_class(const std::string& word) const {
  // What is said seldom may be a typing error.
  constexpr std::size_t least_often = 8;
  const auto said = example_words_.find(word);
  return class_words_.contains(word) ||
         (said != example_words_.end() && said->second >= least_often);
}

bool Lexicon::is_in(WordClass word_class, const std::string& phrase) const {
  return classes_.contains({word_class, phrase});
}

std::span<const std::uint32_t> Lexicon::find(const std::string& phrase) const {
  const auto known = phrases_.find(is_quoted(phrase) ? std::string(quoted_word) : phrase);
  if (known == phrases_.end())
    return {};
  return known->second;
}

const double* Lexicon::filler(const std::string& phrase) const {
  const auto known = fillers_.find(phrase);
  return known == fillers_.end() ? nullptr : &known->second;
}

std::string Lexicon::name_of(const Category& category) const {
  for (const auto& known : names_)
    if (FeatureSubstitution().unify(known.category, category))
      return known.name;
  return to_string(category, symbols_);
}

bool Lexicon::knows(const std::string& word) const {
  return words_.contains(word) ||
         (is_quoted(word) && phrases_.contains(std::string(quoted_word))) ||
         (is_numeral(word) && words_.contains(std::string(any_numeral)));
}

std::vector<std::string> Lexicon::suggestions(std::string_view word, std::size_t most) const {
  struct Candidate {
    std::size_t distance;
    std::size_t common;
    std::uint32_t entries;
    const std::string* word;
  };
  const std::size_t limit = word.size() < 3 ? 0 : word.size() < 6 ? 1 : 2;
  std::vector<Candidate> candidates;
  for (const auto& [known, use] : words_) {
    const auto distance = edit_distance(word, known, limit);
    if (distance <= limit && known.size() > 1)
      candidates.push_back({distance, common_letters(word, known), use.entries, &known});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, b.common, b.entries, *a.word) <
           std::tie(b.distance, a.common, a.entries, *b.word);
  });
  std::vector<std::string> nearest;
  for (std::size_t i = 0; i < std::min(most, candidates.size()); ++i)
    nearest.push_back(*candidates[i].word);
  return nearest;
}

} // namespace castor::communication
