#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <utility>

/// The words of one statement of a line-oriented text file (base/text_file.hpp), taken one by one.
namespace castor {

/// Error in a statement, with its remedy.
class StatementError : public std::runtime_error {
public:
  StatementError(const std::string& message, std::string remedy)
    : std::runtime_error(message), remedy_(std::move(remedy)) {
    // nop
  }

  const std::string& remedy() const { return remedy_; }

private:
  std::string remedy_;
};

class StatementWords {
public:
  explicit StatementWords(std::span<const std::string> words) : words_(words) {
    // nop
  }

  bool at_end() const { return words_.empty(); }

  /// The next word, empty at the end.
  std::string peek() const { return at_end() ? std::string() : words_.front(); }

  /// Takes the next word.
  /// \throws StatementError at the end, with the message that `what` is missing.
  std::string next(const std::string& what);

  /// Takes the next word if it is `word`; returns whether it was.
  bool accept(const std::string& word);

  /// Takes a number, or a length in metres.
  /// \throws StatementError if there is none, or if it is not in [low, high].
  double number(const std::string& what, double low, double high);
  double length(const std::string& what, double low, double high);

  /// Takes a time, such as 2s; in seconds.
  /// \throws StatementError if there is none, or if it is not in [0, high].
  double seconds(const std::string& what, double high);

  /// Takes a name: one word of at most 64 letters, digits, - and _.
  /// \throws StatementError if there is none.
  std::string name(const std::string& what);

  /// \throws StatementError if there is a word left.
  void expect_end() const;

private:
  std::span<const std::string> words_;
};

/// One word of at most 64 lower case letters, digits, - and _.
bool is_statement_name(const std::string& word);

/// The number as people write it.
std::string readable(double number);

/// "a, b, c".
std::string joined(std::span<const std::string> names);

/// The name that `word` is a misspelling of, or a list of all: "The shapes are: cube, box."
std::string remedy_for(const std::string& word, std::span<const std::string> names,
                       const std::string& what);

} // namespace castor
