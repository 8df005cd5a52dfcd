#include "castor/base/text.hpp"

#include <algorithm>
#include <array>

namespace castor {

namespace {

constexpr std::size_t longest_quotation = 80;

/// Whether a terminal shows it, instead of obeying it or showing what follows in another order.
constexpr bool is_shown(char32_t x) noexcept {
  bool is_control = x < 0x20 || (x >= 0x7f && x < 0xa0) || x == 0x2028 || x == 0x2029;
  bool turns_text = x == 0x200e || x == 0x200f || x == 0x61c || (x >= 0x202a && x <= 0x202e) ||
                    (x >= 0x2066 && x <= 0x2069);
  return !is_control && !turns_text;
}

constexpr bool is_continuation(char c) noexcept {
  return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
}

} // namespace

bool is_identifier(std::string_view text) noexcept {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
}

std::string_view trim(std::string_view text) noexcept {
  auto blank_or_control = [](char c) { return static_cast<unsigned char>(c) <= 0x20; };
  while (!text.empty() && blank_or_control(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && blank_or_control(text.back()))
    text.remove_suffix(1);
  return text;
}

std::string_view take_word(std::string_view& rest) noexcept {
  auto begin = std::find_if_not(rest.begin(), rest.end(), is_blank);
  auto end = std::find_if(begin, rest.end(), is_blank);
  auto offset = static_cast<std::size_t>(begin - rest.begin());
  auto word = rest.substr(offset, static_cast<std::size_t>(end - begin));
  rest.remove_prefix(offset + word.size());
  return word;
}

Utf8Character first_character(std::string_view text) noexcept {
  if (text.empty())
    return {};
  auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  auto first = byte(0);
  if (first < 0x80)
    return {first, 1};
  std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length)
    return {};
  char32_t code = first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_continuation(text[i]))
      return {};
    code = code << 6U | (byte(i) & 0x3fU);
  }
  constexpr std::array<char32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
  bool is_surrogate = code >= 0xd800 && code < 0xe000;
  if (code < smallest[length] || code > 0x10ffff || is_surrogate)
    return {};
  return {code, length};
}

bool is_utf8(std::string_view text) noexcept {
  while (!text.empty()) {
    auto bytes = first_character(text).bytes;
    if (bytes == 0)
      return false;
    text.remove_prefix(bytes);
  }
  return true;
}

std::string_view whole_characters(std::string_view text, std::size_t max_bytes) noexcept {
  if (text.size() <= max_bytes)
    return text;
  auto cut = max_bytes;
  while (cut > 0 && max_bytes - cut < 3 && is_continuation(text[cut]))
    --cut;
  return text.substr(0, cut);
}

std::string shorten(std::string_view text, std::size_t max_bytes) {
  std::string result{whole_characters(text, max_bytes)};
  return text.size() <= max_bytes ? result : result + "...";
}

std::string in_quotes(std::string_view text) {
  return "'" + shorten(text, longest_quotation) + "'";
}

std::string on_one_line(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    auto end = std::min(text.find('\n'), text.size());
    auto line = trim(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty())
      result.append(result.empty() ? "" : "; ").append(line);
  }
  return result;
}

std::string printable(std::string_view text) {
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    auto [code, bytes] = first_character(text);
    if (bytes > 0 && is_shown(code)) {
      result += text.substr(0, bytes);
    } else if (code == '\t') {
      result += ' ';
    } else {
      // Byte by byte: of a character that is not shown, what follows its first byte is none.
      bytes = 1;
      auto byte = static_cast<unsigned char>(text.front());
      result += "\\x";
      result += digits[byte >> 4U];
      result += digits[byte & 0xfU];
    }
    text.remove_prefix(bytes);
  }
  return result;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (auto& c : result)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return result;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::optional<bool> parse_truth(std::string_view text) noexcept {
  for (auto yes : {"true", "yes", "on", "1"})
    if (text == yes)
      return true;
  for (auto no : {"false", "no", "off", "0"})
    if (text == no)
      return false;
  return std::nullopt;
}

} // namespace castor
