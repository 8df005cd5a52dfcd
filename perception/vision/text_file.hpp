#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// What the readers of line-oriented text files (scenes, camera calibrations) have in common:
/// lines, words, numbers with units, and problems that are reported all at once.
namespace castor::vision {

/// Something to tell the author of a text file about one of its lines.
struct TextProblem {
  enum class Severity { warning, error };

  Severity severity = Severity::error;
  std::string file;
  /// Counted from 1; 0 if it is about the file as a whole.
  int line = 0;
  /// The line as it was written.
  std::string text;
  std::string message;
  /// What to do about it; never empty.
  std::string remedy;

  friend bool operator==(const TextProblem&, const TextProblem&) = default;
};

/// "FILE:LINE: error: MESSAGE", the line itself and the remedy, on lines of their own.
std::string to_string(const TextProblem& problem);

/// All problems, one after the other.
std::string to_string(std::span<const TextProblem> problems);

bool has_errors(std::span<const TextProblem> problems);

/// Thrown for a text file that cannot be used; what() tells of all its problems.
class TextFileError : public std::runtime_error {
public:
  explicit TextFileError(std::vector<TextProblem> problems);

  const std::vector<TextProblem>& problems() const { return problems_; }

private:
  std::vector<TextProblem> problems_;
};

/// The contents of a text file.
/// \throws TextFileError if there is no such file, or if it cannot be read, or is longer than 1
/// MiB.
std::string load_text(const std::filesystem::path& path);

/// Writes a text file: all of it, or, if that fails, nothing.
/// \throws TextFileError if it cannot be written.
void save_text(const std::filesystem::path& path, std::string_view text);

/// One line that says something: its words, without the comment that `#` begins. A `#` within a
/// word begins no comment, nor does a colour code such as #ff8000.
struct TextLine {
  int number = 0;
  std::string text;
  std::vector<std::string> words;
};

/// The lines of `text` that have words; all words in lower case. Line ends may be of any system.
std::vector<TextLine> text_lines(std::string_view text);

/// The finite number that the whole of `word` is, written with a decimal point.
std::optional<double> parse_number(std::string_view word);

/// A length in metres: a number, or one with the unit m, cm or mm.
std::optional<double> parse_length(std::string_view word);

/// A time in seconds: a number with the unit s, ms or min.
std::optional<double> parse_seconds(std::string_view word);

/// The one of `names` that `word` was probably meant to be; nothing if none is close.
std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names);

} // namespace castor::vision
