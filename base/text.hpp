#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace castor {

/// Blanks separate words. Other control characters do not.
constexpr bool is_blank(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

/// Letters and digits of ASCII, the only ones in names of the `.cast` language.
constexpr bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
constexpr bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

/// A letter, then letters, digits and underscores: the valid names of variables and hosts.
bool is_identifier(std::string_view text) noexcept;

/// Removes blanks and all other control characters from both ends.
std::string_view trim(std::string_view text) noexcept;

/// Removes the first word from `rest` and returns it; empty at the end.
std::string_view take_word(std::string_view& rest) noexcept;

/// A character of UTF-8: its code point, and its length in bytes.
struct Utf8Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};

/// First character of the text; `bytes` is 0 if the text does not begin with valid UTF-8 (Unicode,
/// table 3-7).
Utf8Character first_character(std::string_view text) noexcept;

bool is_utf8(std::string_view text) noexcept;

/// Longest prefix of at most `max_bytes` bytes that does not cut a character.
std::string_view whole_characters(std::string_view text, std::size_t max_bytes) noexcept;

/// Cuts long text at a character boundary and marks the cut.
std::string shorten(std::string_view text, std::size_t max_bytes);

/// The text in single quotes, shortened: for messages.
std::string in_quotes(std::string_view text);

/// Joins the lines of a text with semicolons, without indentation and empty lines.
std::string on_one_line(std::string_view text);

/// Replaces characters that could control a terminal or disguise the text by visible escapes:
/// control characters, also those of Unicode, and bytes that are not UTF-8. A tab becomes a blank.
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

/// Puts `to` wherever `from`, which is not empty, stands; not again within what it has put there.
void replace_all(std::string& text, std::string_view from, std::string_view to);

/// true, yes, on, 1; false, no, off, 0; nothing for any other text.
std::optional<bool> parse_truth(std::string_view text) noexcept;

} // namespace castor
