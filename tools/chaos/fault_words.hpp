#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// Words that join the parts of a statement. A name that is spelt like one of them is written in
/// quotes; all other words of the language may be names too.
inline constexpr std::array<std::string_view, 10> reserved_words{
  "and", "any", "between", "by", "for", "from", "in", "of", "on", "or"};

constexpr bool is_reserved(std::string_view word) {
  return std::ranges::find(reserved_words, word) != reserved_words.end();
}

/// Whether the character may be part of a name without quotes.
constexpr bool continues_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view{"_-.:/@+="}.find(c) != std::string_view::npos;
}

/// A word of a statement, a comma, or a name in quotes.
struct Word {
  std::string text;
  /// In quotes: always a name, never a keyword.
  bool quoted = false;

  /// Whether it is this keyword, not a quoted name.
  bool is(std::string_view keyword) const { return !quoted && text == keyword; }
};

/// Removes and returns the first word of a piece of a line; nothing at its end or at a comment.
/// @param unfinished becomes true if a quote has no end; then there is no word
std::optional<Word> take_next_word(std::string_view& rest, bool& unfinished);

/// The words of a piece of a line, without the comment at its end.
/// @param unfinished becomes true if a quote has no end
std::vector<Word> split_words(std::string_view text, bool& unfinished);

/// The text in quotes, escaped so that it can be parsed again.
std::string quoted_in_plan(std::string_view text);

/// Position of the colon that ends a change filter: the first one outside of quotes that is
/// followed by a blank or by the end of the text. The end of the text if there is none.
std::size_t end_of_filter(std::string_view text);

} // namespace castor::faults
