#include "castor/perception/vision/text_file.hpp"

#include "castor/base/input_file.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace castor::vision {

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

/// How many letters to add, drop, change or swap with their neighbour to make `a` of `b` (the
/// "optimal string alignment" variant of Damerau's and Levenshtein's distance).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_previous(b.size() + 1);
  std::vector<std::size_t> previous(b.size() + 1);
  std::vector<std::size_t> current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    current[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_previous.swap(previous);
    previous.swap(current);
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before_previous[j - 2] + 1);
    }
  }
  return current[b.size()];
}

TextFileError unreadable(const std::filesystem::path& path, std::string message,
                         std::string remedy) {
  return TextFileError(
    {{TextProblem::Severity::error, path.string(), 0, "", std::move(message), std::move(remedy)}});
}

} // namespace

std::string to_string(const TextProblem& problem) {
  std::string result = problem.file;
  if (problem.line > 0)
    result += ":" + std::to_string(problem.line);
  result += problem.severity == TextProblem::Severity::error ? ": error: " : ": warning: ";
  result += printable(problem.message) + "\n";
  if (!problem.text.empty())
    result += "    " + printable(problem.text) + "\n";
  return result + "  " + printable(problem.remedy) + "\n";
}

std::string to_string(std::span<const TextProblem> problems) {
  std::string result;
  for (const auto& problem : problems)
    result += to_string(problem);
  return result;
}

bool has_errors(std::span<const TextProblem> problems) {
  return std::any_of(problems.begin(), problems.end(), [](const TextProblem& problem) {
    return problem.severity == TextProblem::Severity::error;
  });
}

TextFileError::TextFileError(std::vector<TextProblem> problems)
  : std::runtime_error(to_string(problems)), problems_(std::move(problems)) {
  // nop
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
        throw unreadable(path, e.what(), "Write into a file what comes from it, and name that.");
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
  // Who reads it meanwhile, or after this process has died, finds the old text or the new one.
  auto beside = path;
  beside += ".new";
  std::ofstream file(beside, std::ios::binary | std::ios::trunc);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  std::error_code error;
  if (file)
    std::filesystem::rename(beside, path, error);
  if (!file || error) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw unreadable(path, "the file cannot be written",
                     "Check that its folder exists, that you may write there, and that the disk is "
                     "not full.");
  }
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

std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names) {
  std::optional<std::string> nearest;
  std::size_t allowed = std::max<std::size_t>(1, word.size() / 3);
  for (const auto& name : names) {
    const auto distance = edit_distance(word, name);
    if (distance <= allowed && distance < std::max(word.size(), name.size())) {
      nearest = name;
      if (distance == 0)
        break;
      allowed = distance - 1;
    }
  }
  return nearest;
}

} // namespace castor::vision
