#include "castor/communication/parsing/spelling.hpp"

#include "castor/communication/parsing/english_words.hpp"
#include "castor/communication/parsing/stem.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

/// Words shorter than this are likelier others than misspelt.
constexpr std::size_t shortest_word = 3;

/// In shorter words, another letter makes another word.
constexpr std::size_t shortest_with_another_letter = 5;

/// Shorter words of which that is not so: they are said too often for a rare word to be meant.
constexpr std::array frequent_words{"with", "that", "have", "over", "each", "from", "than", "blue"};

/// Meant even if what is said is another word: a "cub" is a cube.
constexpr std::array names_of_things{"ball", "cube",   "red",    "green",
                                     "blue", "yellow", "purple", "orange"};

bool is_without_one_letter(std::string_view longer, std::string_view shorter) {
  if (longer.size() != shorter.size() + 1)
    return false;
  const auto [a, b] = std::ranges::mismatch(longer, shorter);
  return std::equal(a + 1, longer.end(), b);
}

bool is_a_letter_off(std::string_view word, std::string_view known) {
  if (is_without_one_letter(known, word))
    return true;
  if (is_without_one_letter(word, known))
    return word.size() > shortest_word;
  if (word.size() != known.size())
    return false;
  const auto begin =
    static_cast<std::size_t>(std::ranges::mismatch(word, known).in1 - word.begin());
  const auto rest = [begin](std::string_view x, std::size_t skipped) {
    return x.substr(begin + skipped);
  };
  if (begin + 1 < word.size() && word[begin] == known[begin + 1] &&
      word[begin + 1] == known[begin] && rest(word, 2) == rest(known, 2))
    return true;
  const bool may_have_another_letter =
    word.size() >= shortest_with_another_letter ||
    (begin > 0 && std::ranges::find(frequent_words, known) != frequent_words.end());
  return begin < word.size() && may_have_another_letter && rest(word, 1) == rest(known, 1);
}

/// Words that others are often written together with.
constexpr std::array articles{"a", "an", "the"};

/// "atleast", "ablue": two known words without the blank between them; empty if it is neither.
std::vector<std::string> split(const std::string& word, const Lexicon& lexicon) {
  for (std::size_t length = 1; length < word.size(); ++length) {
    const auto first = word.substr(0, length);
    const auto second = word.substr(length);
    if (second.size() < shortest_word || !lexicon.knows(first) || !lexicon.knows(second))
      continue;
    const bool is_article = std::ranges::find(articles, first) != articles.end();
    if (is_article || !lexicon.find(first + ' ' + second).empty())
      return {first, second};
  }
  return {};
}

/// What the first word of an utterance was before its first letter was lost: "ll towers", "t
/// least", "tleast"; empty if there is no such word.
std::vector<std::string> with_first_letter(const std::string& word, const std::string& next,
                                           const Lexicon& lexicon) {
  std::vector<std::string> result;
  for (char letter = 'a'; letter <= 'z'; ++letter) {
    const auto whole = letter + word;
    if (auto two = split(whole, lexicon); !two.empty() && result.empty())
      result = two;
    if (!lexicon.knows(whole))
      continue;
    if (!lexicon.find(whole + ' ' + next).empty())
      return {whole};
    if (result.empty())
      result = {whole};
  }
  return result;
}

/// The known word that a word is a letter off, its last one if it is short; empty if there is none.
std::string a_letter_off(const std::string& word, const Lexicon& lexicon) {
  if (word.size() < shortest_word) {
    for (char letter = 'z'; letter >= 'a'; --letter)
      if (word.size() > 1 && lexicon.knows(word + letter))
        return word + letter;
    return {};
  }
  auto known = lexicon.suggestions(word, 8);
  // What is spelt rightly is that word, or another form of one of ours.
  if (is_english_word(word))
    std::erase_if(known, [stem = stem_of(word)](const auto& x) {
      return stem_of(x) != stem && std::ranges::find(names_of_things, x) == names_of_things.end();
    });
  // "Gingerly" is no other word than another adverb.
  const bool is_adverb = word.ends_with("ly");
  std::erase_if(known, [&](auto& x) {
    return !is_a_letter_off(word, x) || lexicon.is_in(WordClass::name, x) ||
           (is_adverb && !x.ends_with("y"));
  });
  // The first letter is seldom wrong.
  auto found = std::ranges::find(known, word.front(), [](auto& x) { return x.front(); });
  if (found != known.end())
    return *found;
  return known.empty() ? std::string{} : known.front();
}

/// "Sooo", "hiii", "cooool" without letters that are there to make it long; empty if that is no
/// known word.
std::string without_long_letters(const std::string& word, const Lexicon& lexicon) {
  for (const std::size_t most : {2U, 1U}) {
    std::string result;
    bool is_shorter = false;
    for (std::size_t begin = 0; begin < word.size();) {
      const auto end = std::min(word.find_first_not_of(word[begin], begin), word.size());
      const auto length = end - begin;
      is_shorter = is_shorter || length > 2;
      result.append(length > 2 ? most : length, word[begin]);
      begin = end;
    }
    if (is_shorter && (lexicon.knows(result) || lexicon.is_in_a_class(result)))
      return result;
  }
  return {};
}

} // namespace

std::vector<SpellingCorrection> correct_spelling(std::vector<std::string>& words,
                                                 const Lexicon& lexicon) {
  std::vector<SpellingCorrection> result;
  std::vector<std::string> corrected;
  for (std::size_t i = 0; i < words.size(); ++i) {
    auto& word = words[i];
    if (word == "," || is_quoted(word) || lexicon.knows(word) || lexicon.is_in_a_class(word)) {
      corrected.push_back(word);
      continue;
    }
    if (auto plain = without_long_letters(word, lexicon); !plain.empty()) {
      corrected.push_back(std::move(plain));
      continue;
    }
    auto meant = split(word, lexicon);
    const bool is_short = word.size() < shortest_word;
    if (meant.empty() && i == 0 && words.size() > 1)
      if (auto whole = with_first_letter(word, words[1], lexicon); whole.size() == 2 || is_short)
        meant = whole;
    if (meant.empty())
      if (auto other = a_letter_off(word, lexicon); !other.empty())
        meant = {other};
    if (meant.empty()) {
      corrected.push_back(word);
      continue;
    }
    result.push_back({word, meant.front() + (meant.size() > 1 ? ' ' + meant.back() : "")});
    corrected.insert(corrected.end(), meant.begin(), meant.end());
  }
  words = std::move(corrected);
  return result;
}

} // namespace castor::communication
