#include "castor/communication/parsing/spelling.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace castor::communication {

namespace {

/// Words shorter than this are likelier others than misspelt.
constexpr std::size_t shortest_word = 3;

/// In shorter words, another letter makes another word.
constexpr std::size_t shortest_with_another_letter = 5;

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
  return begin < word.size() && word.size() >= shortest_with_another_letter &&
         rest(word, 1) == rest(known, 1);
}

} // namespace

std::vector<SpellingCorrection> correct_spelling(std::vector<std::string>& words,
                                                 const Lexicon& lexicon) {
  std::vector<SpellingCorrection> result;
  auto corrected = words;
  for (auto& word : corrected) {
    if (word == "," || lexicon.knows(word))
      continue;
    const auto known = lexicon.suggestions(word, 8);
    const auto meant =
      std::ranges::find_if(known, [&word](auto& x) { return is_a_letter_off(word, x); });
    if (word.size() < shortest_word || meant == known.end())
      return {};
    result.push_back({word, *meant});
    word = *meant;
  }
  words = std::move(corrected);
  return result;
}

} // namespace castor::communication
