#include "castor/communication/dialogue/self_correction.hpp"

#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace castor::communication {

namespace {

using Words = std::vector<std::string>;

/// Words of "the light green cube", without the article.
constexpr std::ptrdiff_t most_words_of_phrase = 3;

bool is_sign(const std::string& word) {
  return is_among(word, {"no", "sorry", "rather", "mean", "meant", "correction", "oops", "wait"});
}

bool may_belong_to_sign(const std::string& word) {
  return is_sign(word) || is_among(word, {",", "i", "or", "actually", "not", "oh", "i'm"});
}

} // namespace

std::optional<Words> self_corrected(const Words& words) {
  // "... , no , i mean | the green cube".
  const auto is_article = [](const std::string& x) { return x == "the" || x == "a"; };
  const auto last = std::find_if(words.rbegin(), words.rend(), is_article);
  if (last == words.rend() || last == words.rbegin())
    return std::nullopt;
  const auto phrase = std::prev(last.base());
  const auto length = std::distance(phrase, words.end()) - 1;
  if (length > most_words_of_phrase ||
      std::find(phrase, words.end(), std::string{","}) != words.end())
    return std::nullopt;
  auto sign = phrase;
  while (sign != words.begin() && may_belong_to_sign(*std::prev(sign)))
    --sign;
  if (sign == phrase || *sign != "," || std::none_of(sign, phrase, is_sign))
    return std::nullopt;
  const auto& noun = words.back();
  if (sign == words.begin() || *std::prev(sign) == noun ||
      std::count(words.begin(), sign, noun) != 1)
    return std::nullopt;
  const auto old = std::find(words.begin(), sign, noun);
  auto article = old;
  while (article != words.begin() && old - article <= most_words_of_phrase && !is_article(*article))
    --article;
  if (!is_article(*article))
    return std::nullopt;
  Words result{words.begin(), article};
  result.insert(result.end(), phrase, words.end());
  result.insert(result.end(), std::next(old), sign);
  return result;
}

} // namespace castor::communication
