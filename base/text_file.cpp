#include "castor/base/text_file.hpp"

#include "castor/base/input_file.hpp"
#include "castor/base/output_file.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

namespace castor {

namespace {

constexpr std::size_t max_text_bytes = 1 << 20;

bool is_space(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

bool is_hex_digit(char c) {
  return std::isxdigit(static_cast<unsigned char>(c)) != 0;
}

/// Whether the `#` at `begin` starts six hexadecimal digits and nothing more, as in #ff8000.
bool is_colour_code(std::string_view line, std::size_t begin) {
  const auto word = line.substr(begin + 1, 7);
  return word.size() >= 6 && std::all_of(word.begin(), word.begin() + 6, is_hex_digit) &&
         (word.size() == 6 || is_space(word[6]));
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < line.size();) {
    if (is_space(line[i])) {
      ++i;
      continue;
    }
    if (line[i] == '#' && !is_colour_code(line, i))
      break;
    std::string word;
    for (; i < line.size() && !is_space(line[i]); ++i)
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(line[i])));
    words.push_back(std::move(word));
  }
  return words;
}

/// The number before one of the `units`, times that unit's factor.
std::optional<double>
parse_quantity(std::string_view word,
               std::initializer_list<std::pair<std::string_view, double>> units) {
  for (const auto& [unit, factor] : units)
    if (word.ends_with(unit))
      if (const auto number = parse_number(word.substr(0, word.size() - unit.size())))
        return *number * factor;
  return std::nullopt;
}

TextFileError unreadable(const std::filesystem::path& path, std::string message,
                         std::string remedy) {
  return TextFileError(
    {finding(Severity::error, path.string(), {}, std::move(message), std::move(remedy))});
}

} // namespace

TextFileError::TextFileError(std::vector<Diagnostic> problems)
  : std::runtime_error(render(problems)), problems_(std::move(problems)) {
  // nop
}

Diagnostic finding(Severity severity, const std::string& file, const TextLine& line,
                   std::string message, std::string remedy) {
  Diagnostic result;
  result.severity = severity;
  result.where = {file, static_cast<std::size_t>(line.number)};
  result.line = line.text;
  result.message = std::move(message);
  result.remedy = std::move(remedy);
  return result;
}

std::string load_text(const std::filesystem::path& path) {
  try {
    return read_input_file(path, max_text_bytes);
  } catch (const InputFileError& e) {
    switch (e.reason()) {
      case InputFileError::Reason::missing:
        throw unreadable(path, e.what(), "Check the name and the folder.");
      case InputFileError::Reason::folder:
        throw unreadable(path, "this is a folder, not a file", "Name a file in it.");
      case InputFileError::Reason::special:
        throw unreadable(path, e.what(), "Copy its output into a regular file, and name that.");
      case InputFileError::Reason::too_long:
        throw unreadable(path, "the file is longer than 1 MiB",
                         "Check that it is the right file; such a text has a few lines.");
      case InputFileError::Reason::unreadable:
        break;
    }
    throw unreadable(path, std::string{"the file cannot be read ("} + e.what() + ")",
                     "Check that you may read it.");
  }
}

void save_text(const std::filesystem::path& path, std::string_view text) {
  if (!replace_file(path, text))
    throw unreadable(path, "the file cannot be written",
                     "Check that its folder exists, that you may write there, and that the disk is "
                     "not full.");
}

std::vector<TextLine> text_lines(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark))
    text.remove_prefix(byte_order_mark.size());
  std::vector<TextLine> lines;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const auto end = text.find_first_of("\r\n");
    std::string_view line = text.substr(0, end);
    if (end == std::string_view::npos)
      text = {};
    else
      text.remove_prefix(end + (text.substr(end).starts_with("\r\n") ? 2 : 1));
    auto words = words_of(line);
    if (words.empty())
      continue;
    while (is_space(line.front()))
      line.remove_prefix(1);
    while (is_space(line.back()))
      line.remove_suffix(1);
    lines.push_back({number, std::string(line), std::move(words)});
  }
  return lines;
}

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+') && word.size() > 1 && word[1] != '-')
    word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<double> parse_length(std::string_view word) {
  return parse_quantity(word, {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"", 1}});
}

std::optional<double> parse_seconds(std::string_view word) {
  return parse_quantity(word, {{"ms", 0.001}, {"min", 60}, {"s", 1}});
}

} // namespace castor
