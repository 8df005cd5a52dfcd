#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace castor {

/// Blanks separate words. Other control characters are ordinary.
constexpr bool is_blank(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

/// Letters and digits of ASCII; the language has no others in its names.
constexpr bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
constexpr bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

/// A letter, then letters, digits and underscores: what variables and hosts may be called.
bool is_identifier(std::string_view text) noexcept;

/// Removes blanks and all other control characters from both ends.
std::string_view trim(std::string_view text) noexcept;

/// Cuts off and returns the first word; `rest` is left with what follows it. Empty at the end.
std::string_view take_word(std::string_view& rest) noexcept;

/// A character of UTF-8: its number, and its length.
struct Utf8Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};

/// The character with which the text begins; of no bytes if it begins with none (Unicode, table
/// 3-7).
Utf8Character first_character(std::string_view text) noexcept;

bool is_utf8(std::string_view text) noexcept;

/// As much of the beginning of a text as fits into so many bytes, without half a character.
std::string_view whole_characters(std::string_view text, std::size_t max_bytes) noexcept;

/// Cuts long text at a character boundary and marks the cut, so that a message stays readable.
std::string shorten(std::string_view text, std::size_t max_bytes);

/// The text in single quotes, shortened: for messages.
std::string in_quotes(std::string_view text);

/// The lines of a text as one, without indentation and empty ones, separated by semicolons.
std::string on_one_line(std::string_view text);

/// Replaces what could drive a terminal or disguise the text by visible escapes: control
/// characters, also those of Unicode, and bytes that are not UTF-8. A tab becomes a blank.
std::string printable(std::string_view text);

/// "a, b, c", or "a, b and 7 more" beyond `most`.
template <class Names>
std::string list_of(const Names& names, std::size_t most) {
  std::string result;
  std::size_t count = 0;
  for (auto&& x : names) {
    if (++count > most)
      return result + " and " + std::to_string(names.size() - most) + " more";
    result.append(count == 1 ? "" : ", ").append(x);
  }
  return result;
}

std::string lower_case(std::string_view text);

/// true, yes, on, 1; false, no, off, 0; nothing for any other text.
std::optional<bool> parse_truth(std::string_view text) noexcept;

} // namespace castor
