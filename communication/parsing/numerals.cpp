#include "castor/communication/parsing/numerals.hpp"

#include "castor/communication/parsing/word_lists.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace castor::communication {

namespace {

using Words = std::span<const std::string>;

constexpr std::array<std::string_view, 20> below_twenty{
  "zero",     "one",     "two",     "three",     "four",     "five",    "six",
  "seven",    "eight",   "nine",    "ten",       "eleven",   "twelve",  "thirteen",
  "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"};
constexpr std::array<std::string_view, 8> tens{"twenty", "thirty",  "forty",  "fifty",
                                               "sixty",  "seventy", "eighty", "ninety"};

/// A number or a length that begins an utterance, and how many words say it.
struct Said {
  double value = 0;
  std::size_t words = 0;
};

/// The place of a word in a list; nothing if it is not there.
template <std::size_t Size>
std::optional<std::size_t> place_in(const std::array<std::string_view, Size>& list,
                                    std::string_view word) {
  const auto found = std::ranges::find(list, word);
  return found == list.end() ? std::nullopt : std::optional<std::size_t>{found - list.begin()};
}

double value_of_numeral(std::string_view word) {
  double value = 0;
  std::from_chars(word.data(), word.data() + word.size(), value);
  return value;
}

/// "7", "seven", "forty five".
std::optional<Said> whole_number(Words words) {
  if (words.empty())
    return std::nullopt;
  if (is_numeral(words.front()))
    return Said{value_of_numeral(words.front()), 1};
  if (const auto small = place_in(below_twenty, words.front()))
    return Said{static_cast<double>(*small), 1};
  const auto ten = place_in(tens, words.front());
  if (!ten)
    return std::nullopt;
  const auto value = static_cast<double>(*ten + 2) * 10;
  const auto rest = words.size() > 1 ? place_in(below_twenty, words[1]) : std::nullopt;
  if (rest && *rest > 0 && *rest < 10)
    return Said{value + static_cast<double>(*rest), 2};
  return Said{value, 1};
}

/// "Seven", "seven and a half", "half a".
std::optional<Said> number(Words words) {
  if (words.size() > 1 && words[0] == "half" && is_among(words[1], {"a", "an"}))
    return Said{0.5, 2};
  auto said = whole_number(words);
  if (!said)
    return said;
  const auto rest = words.subspan(said->words);
  if (rest.size() > 2 && rest[0] == "and" && rest[1] == "a" && rest[2] == "half") {
    said->value += 0.5;
    said->words += 3;
  }
  return said;
}

/// In centimetres; nothing if the word is no unit.
std::optional<double> unit(std::string_view word) {
  if (is_among(word, {"cm", "cms", "centimetre", "centimetres", "centimeter", "centimeters"}))
    return 1;
  if (is_among(word, {"mm", "millimetre", "millimetres", "millimeter", "millimeters"}))
    return 0.1;
  if (is_among(word, {"inch", "inches"}))
    return 2.54;
  if (is_among(word, {"m", "metre", "metres", "meter", "meters"}))
    return 100;
  return std::nullopt;
}

bool says_roughly(std::string_view word) {
  return is_among(word, {"about", "roughly", "approximately", "around", "exactly", "nearly",
                         "almost", "some", "circa", "precisely"});
}

} // namespace

bool is_numeral(std::string_view word) {
  double value = 0;
  const auto* end = word.data() + word.size();
  return !word.empty() && std::isdigit(static_cast<unsigned char>(word.front())) != 0 &&
         std::from_chars(word.data(), end, value).ptr == end;
}

std::string numeral(double value) {
  const auto rounded = std::round(value * 100) / 100;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), rounded).ptr;
  return {text.data(), end};
}

double metres_of_centimetres(std::string_view number) {
  return value_of_numeral(number) / 100;
}

std::vector<std::string> with_numerals(std::vector<std::string> words) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < words.size();) {
    const auto rest = Words{words}.subspan(i);
    const std::size_t before = says_roughly(rest.front()) ? 1 : 0;
    const auto said = number(rest.subspan(before));
    const auto after = said ? rest.subspan(before + said->words) : Words{};
    if (const auto scale = after.empty() ? std::nullopt : unit(after.front())) {
      result.push_back(numeral(said->value * *scale));
      result.emplace_back("cm");
      i += before + said->words + 1;
    } else if (said && before == 0 && (said->words > 1 || said->value > 12) &&
               rest.front() != "half") {
      result.push_back(numeral(said->value));
      i += said->words;
    } else {
      result.push_back(std::move(words[i++]));
    }
  }
  return result;
}

} // namespace castor::communication
