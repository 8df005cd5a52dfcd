#include "castor/communication/dialogue/self_correction.hpp"

#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>

namespace castor::communication {

namespace {

using Words = std::vector<std::string>;

/// Words of "the light green cube", without the article.
constexpr std::size_t most_words_of_phrase = 3;

bool is_sign(const std::string& word) {
  return is_among(word, {"no", "sorry", "rather", "mean", "meant", "correction", "oops", "wait"});
}

bool may_belong_to_sign(const std::string& word) {
  return is_sign(word) || is_among(word, {",", "i", "or", "actually", "oh"});
}

bool is_article(const std::string& word) {
  return word == "the" || word == "a";
}

bool is_side(const std::string& word) {
  return is_among(word, {"left", "right", "front", "back"});
}

bool is_part(const std::string& word) {
  return is_side(word) || is_among(word, {"middle", "centre", "center", "edge", "corner", "side",
                                          "end", "table", "top", "bottom"});
}

bool begins_place(const std::string& word) {
  return is_among(word, {"on", "onto", "to", "at", "in", "into", "behind", "beside", "near", "next",
                         "between", "under"});
}

/// Positions of words.
struct Range {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// ", no, sorry," with something before it.
std::optional<Range> sign_in(const Words& words) {
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    if (words[i] != ",")
      continue;
    auto end = i;
    while (end < words.size() && may_belong_to_sign(words[end]))
      ++end;
    if (end < words.size() &&
        std::any_of(words.begin() + static_cast<std::ptrdiff_t>(i),
                    words.begin() + static_cast<std::ptrdiff_t>(end), is_sign))
      return Range{i, end};
    i = end;
  }
  return std::nullopt;
}

/// The phrase that ends with the word at a position, from its article on.
std::optional<Range> phrase_at(const Words& words, std::size_t last) {
  for (std::size_t i = last; i-- > 0 && last - i <= most_words_of_phrase;) {
    if (words[i] == ",")
      return std::nullopt;
    if (is_article(words[i]))
      return Range{i, last + 1};
  }
  return std::nullopt;
}

Words spliced(const Words& words, const Range& old, const Range& sign, const Range& said) {
  const std::span all{words};
  Words result;
  const auto add = [&](std::size_t begin, std::size_t end) {
    const auto part = all.subspan(begin, end - begin);
    result.insert(result.end(), part.begin(), part.end());
  };
  add(0, old.begin);
  add(said.begin, said.end);
  add(old.end, sign.begin);
  add(said.end, words.size());
  return result;
}

/// "The ball", after the sign.
std::optional<Words> with_thing(const Words& words, const Range& sign, const Range& said) {
  const auto& noun = words[said.end - 1];
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < sign.begin; ++i)
    if (words[i] == noun)
      places.push_back(i);
  if (places.size() == 1) {
    const auto old = phrase_at(words, places.front());
    return old ? std::optional{spliced(words, *old, sign, said)} : std::nullopt;
  }
  // "... the ball, no, the blue one" is of the same kind as the last thing: no part of the table.
  for (auto at = sign.begin; at-- > 0;)
    if (!is_part(words[at]) && !begins_place(words[at]) && !is_article(words[at]))
      if (const auto old = phrase_at(words, at))
        return spliced(words, *old, sign, said);
  return std::nullopt;
}

/// "At the front", after the sign, in place of the last place. What says "it" is about that place.
std::optional<Words> with_place(const Words& words, const Range& sign, const Range& said) {
  constexpr std::size_t most_words_of_place = 6;
  const auto begin = words.begin() + static_cast<std::ptrdiff_t>(said.begin);
  const auto end = words.begin() + static_cast<std::ptrdiff_t>(said.end);
  if (said.end - said.begin > most_words_of_place || std::find(begin, end, "it") != end)
    return std::nullopt;
  for (auto at = sign.begin; at-- > 1;) {
    if (words[at] == ",")
      return std::nullopt;
    // "Next to", and "in front of", from their beginning.
    if (begins_place(words[at]) && words[at - 1] != "next")
      return spliced(words, {at, sign.begin}, sign, said);
  }
  return std::nullopt;
}

/// "On the right of it", after the sign, which was on the left.
std::optional<Words> with_side(const Words& words, const Range& sign, const Range& said) {
  auto side = said.begin;
  while (side < said.end && !is_side(words[side]))
    ++side;
  if (side + 2 >= words.size() || words[side + 1] != "of" || words[side + 2] != "it")
    return std::nullopt;
  auto at = sign.begin;
  while (at > 0 && !is_side(words[at - 1]))
    --at;
  if (at == 0)
    return std::nullopt;
  auto result = spliced(words, {at - 1, at}, sign, {side, side + 1});
  // Without "of it", which is said already.
  result.erase(result.begin() + static_cast<std::ptrdiff_t>(sign.begin),
               result.begin() + static_cast<std::ptrdiff_t>(sign.begin + 2));
  return result;
}

} // namespace

std::optional<Words> self_corrected(const Words& words) {
  const auto sign = sign_in(words);
  if (!sign)
    return std::nullopt;
  const auto begin = words.begin() + static_cast<std::ptrdiff_t>(sign->end);
  const auto end = std::find(begin, words.end(), std::string{","});
  const Range said{sign->end, static_cast<std::size_t>(end - words.begin())};
  const auto length = said.end - said.begin;
  if (is_article(words[said.begin]) && length > 1 && length <= most_words_of_phrase + 1)
    return with_thing(words, *sign, said);
  if (!begins_place(words[said.begin]) || length < 3)
    return std::nullopt;
  if (auto other_side = with_side(words, *sign, said))
    return other_side;
  return with_place(words, *sign, said);
}

} // namespace castor::communication
