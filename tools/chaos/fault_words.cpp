#include "castor/tools/chaos/fault_words.hpp"

#include "castor/base/text.hpp"

#include <optional>

namespace castor::faults {

namespace {

/// Cuts off what stands in quotes, with \" and \\ for quotes and backslashes in it.
std::optional<std::string> take_quoted(std::string_view& rest) {
  std::string result;
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] == '"') {
      rest.remove_prefix(i + 1);
      return result;
    }
    if (rest[i] == '\\' && i + 1 < rest.size())
      ++i;
    result += rest[i];
  }
  return std::nullopt;
}

} // namespace

std::optional<Word> take_next_word(std::string_view& rest, bool& unfinished) {
  while (!rest.empty() && is_blank(rest.front()))
    rest.remove_prefix(1);
  if (rest.empty() || rest.front() == '#')
    return std::nullopt;
  if (rest.front() == '"') {
    auto text = take_quoted(rest);
    if (!text) {
      unfinished = true;
      return std::nullopt;
    }
    return Word{std::move(*text), true};
  }
  std::size_t size = 1;
  if (rest.front() != ',')
    while (size < rest.size() && !is_blank(rest[size]) && rest[size] != ',' && rest[size] != '"')
      ++size;
  Word result{std::string(rest.substr(0, size)), false};
  rest.remove_prefix(size);
  return result;
}

std::vector<Word> split_words(std::string_view rest, bool& unfinished) {
  std::vector<Word> result;
  while (auto word = take_next_word(rest, unfinished))
    result.push_back(*std::move(word));
  return result;
}

std::string quoted_in_plan(std::string_view text) {
  std::string result = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\')
      result += '\\';
    result += c;
  }
  return result + '"';
}

std::size_t end_of_filter(std::string_view text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"')
      quoted = !quoted;
    else if (quoted && text[i] == '\\')
      ++i;
    else if (!quoted && text[i] == ':' && (i + 1 == text.size() || is_blank(text[i + 1])))
      return i;
  }
  return text.size();
}

} // namespace castor::faults
