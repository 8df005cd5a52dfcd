#pragma once

#include "castor/base/diagnostic.hpp"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Common parts of the parsers of line-oriented text files (scenes, camera calibrations): lines,
/// words, numbers with units, and findings that are reported all at once.
namespace castor {

/// A text file cannot be used; what() lists all its problems.
class TextFileError : public std::runtime_error {
public:
  explicit TextFileError(std::vector<Diagnostic> problems);

  const std::vector<Diagnostic>& problems() const { return problems_; }

private:
  std::vector<Diagnostic> problems_;
};

/// The contents of a text file.
/// \throws TextFileError if there is no such file, or if it cannot be read, or is longer than 1
/// MiB.
std::string load_text(const std::filesystem::path& path);

/// Writes a text file atomically.
/// \throws TextFileError if it cannot be written.
void save_text(const std::filesystem::path& path, std::string_view text);

/// What a parser makes of a text file: `parse(text, name of the file)` has `problems`.
/// \throws TextFileError as load_text(), and with all problems if there are errors among them.
template <class Parse>
auto load_parsed(const std::filesystem::path& path, Parse parse) {
  auto result = parse(load_text(path), path.string());
  if (has_errors(result.problems))
    throw TextFileError(std::move(result.problems));
  return result;
}

struct TextLine;

/// A finding in a line of a file.
Diagnostic finding(Severity severity, const std::string& file, const TextLine& line,
                   std::string message, std::string remedy);

/// One line with its words, without the comment after `#`. A `#` within a word, or that of a colour
/// code such as #ff8000, does not begin a comment.
struct TextLine {
  int number = 0;
  std::string text;
  std::vector<std::string> words;
};

/// The lines of `text` that have words; all words in lower case. All kinds of line ends are
/// accepted.
std::vector<TextLine> text_lines(std::string_view text);

/// Parses the whole of `word` as a finite number with a decimal point.
std::optional<double> parse_number(std::string_view word);

/// A length in metres: a number, or one with the unit m, cm or mm.
std::optional<double> parse_length(std::string_view word);

/// A time in seconds: a number with the unit s, ms or min.
std::optional<double> parse_seconds(std::string_view word);

} // namespace castor
