#include "castor/planning/continual/object_name.hpp"

#include "castor/base/text.hpp"

#include <algorithm>

namespace castor::planning {

namespace {

bool is_plain(char c, bool is_first) {
  if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '/')
    return true;
  return !is_first && (c == '-' || c == ':' || c == '.');
}

} // namespace

std::string object_name(std::string_view id) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result;
  for (const char c : id) {
    if (is_plain(c, result.empty())) {
      result += c;
    } else if (c >= 'A' && c <= 'Z') {
      result += "^.";
      result += static_cast<char>(c - 'A' + 'a');
    } else {
      const auto byte = static_cast<unsigned char>(c);
      result += '^';
      result += digits[byte >> 4U];
      result += digits[byte & 15U];
    }
  }
  return result.empty() ? "^" : result;
}

std::string word_name(std::string_view word) {
  auto result = lower_case(std::string(trim(word)));
  std::ranges::replace(result, ' ', '-');
  return object_name(result);
}

} // namespace castor::planning
