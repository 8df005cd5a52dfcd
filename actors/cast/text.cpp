#include "castor/actors/cast/text.hpp"

#include <algorithm>

namespace castor::cast {

namespace {

constexpr std::size_t longest_quotation = 80;

constexpr bool is_control(char c) noexcept {
  auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
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

std::string shorten(std::string_view text, std::size_t max_bytes) {
  if (text.size() <= max_bytes)
    return std::string(text);
  auto is_continuation = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; };
  auto cut = max_bytes;
  while (cut > 0 && max_bytes - cut < 3 && is_continuation(text[cut]))
    --cut;
  return std::string(text.substr(0, cut)) + "...";
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
  for (char c : text) {
    if (!is_control(c)) {
      result += c;
    } else if (c == '\t') {
      result += ' ';
    } else {
      auto byte = static_cast<unsigned char>(c);
      result += "\\x";
      result += digits[byte >> 4U];
      result += digits[byte & 0xfU];
    }
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

std::optional<bool> parse_truth(std::string_view text) noexcept {
  for (auto yes : {"true", "yes", "on", "1"})
    if (text == yes)
      return true;
  for (auto no : {"false", "no", "off", "0"})
    if (text == no)
      return false;
  return std::nullopt;
}

} // namespace castor::cast
