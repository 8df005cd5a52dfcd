#include "castor/mapping/maps/flat_yaml.hpp"

#include "castor/mapping/maps/map_file_error.hpp"

#include <optional>
#include <utility>

namespace castor::mapping {

namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  auto begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos)
    return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// The line without its comment: a `#` at its begin or after a blank, outside of quotes.
std::string_view without_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    auto c = line[i];
    if (quote != 0) {
      if (c == quote)
        quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#' && (i == 0 || blanks.find(line[i - 1]) != std::string_view::npos)) {
      return line.substr(0, i);
    }
  }
  return line;
}

/// The scalar without its quotes; nothing if a quote is not closed.
std::optional<std::string> scalar(std::string_view text) {
  text = trimmed(text);
  if (text.empty() || (text.front() != '"' && text.front() != '\''))
    return std::string{text};
  if (text.size() < 2 || text.back() != text.front())
    return std::nullopt;
  return std::string{text.substr(1, text.size() - 2)};
}

/// The elements of "[a, b]"; nothing if it is not closed.
std::optional<std::vector<std::string>> flow_list(std::string_view text) {
  if (text.back() != ']')
    return std::nullopt;
  text = text.substr(1, text.size() - 2);
  std::vector<std::string> result;
  while (!trimmed(text).empty()) {
    auto end = text.find(',');
    auto element = scalar(text.substr(0, end));
    if (!element)
      return std::nullopt;
    result.push_back(std::move(*element));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return result;
}

/// Finds out what one line means.
class YamlReader {
public:
  explicit YamlReader(std::string file_name) : file_name_(std::move(file_name)) {}

  void read(std::size_t number, std::string_view line) {
    number_ = number;
    line_ = trimmed(line);
    auto text = trimmed(without_comment(line));
    if (text.empty() || text == "---" || text == "...")
      return;
    if (text == "-" || text.starts_with("- "))
      read_element(text.substr(1));
    else if (line.starts_with(' ') || line.starts_with('\t'))
      fail("this line is indented, but belongs to no list",
           "Begin keys at the start of the line, and elements of a list with '- '.");
    else
      read_key(text);
  }

  std::vector<YamlItem> take() { return std::move(items_); }

private:
  void read_key(std::string_view text) {
    auto colon = text.find(':');
    if (colon == std::string_view::npos ||
        (colon + 1 < text.size() && blanks.find(text[colon + 1]) == std::string_view::npos))
      fail("this line is no 'key: value'", "Write a key, a colon, a blank and the value.");
    YamlItem item;
    item.key = trimmed(text.substr(0, colon));
    item.line = number_;
    item.text = line_;
    for (auto& x : items_)
      if (x.key == item.key)
        fail("the key '" + item.key + "' is there twice, first in line " + std::to_string(x.line),
             "Remove one of the lines.");
    auto value = trimmed(text.substr(colon + 1));
    if (value.starts_with('[')) {
      auto list = flow_list(value);
      if (!list)
        fail("the list does not end in this line", "Close it with ']' in the same line.");
      item.values = std::move(*list);
      item.is_list = true;
    } else if (!value.empty()) {
      auto x = scalar(value);
      if (!x)
        fail("the quoted text does not end in this line", "Close it with the same quote.");
      item.values.push_back(std::move(*x));
    }
    items_.push_back(std::move(item));
  }

  void read_element(std::string_view text) {
    if (items_.empty() || (!items_.back().is_list && !items_.back().values.empty()))
      fail("this element belongs to no list", "Write 'key:' in a line of its own before the list.");
    auto x = scalar(text);
    if (!x)
      fail("the quoted text does not end in this line", "Close it with the same quote.");
    items_.back().is_list = true;
    items_.back().values.push_back(std::move(*x));
  }

  [[noreturn]] void fail(std::string message, std::string remedy) const {
    throw MapFileError(file_name_, number_, std::string{line_}, std::move(message),
                       std::move(remedy));
  }

  std::string file_name_;
  std::size_t number_ = 0;
  std::string_view line_;
  std::vector<YamlItem> items_;
};

} // namespace

std::vector<YamlItem> parse_flat_yaml(std::string_view text, const std::string& file_name) {
  YamlReader reader{file_name};
  for (std::size_t number = 1; !text.empty(); ++number) {
    auto end = text.find('\n');
    reader.read(number, text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return reader.take();
}

} // namespace castor::mapping
