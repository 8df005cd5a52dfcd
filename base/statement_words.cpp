#include "castor/base/statement_words.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/base/text_file.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace castor {

namespace {

double in_range(std::optional<double> value, const std::string& word, const std::string& what,
                double low, double high, const std::string& example) {
  if (!value)
    throw StatementError("\"" + word + "\" is not " + what, "Write " + example + ".");
  if (*value < low || *value > high)
    throw StatementError(what + " is " + word + ", which is out of range",
                         "It can be from " + readable(low) + " to " + readable(high) + ".");
  return *value;
}

} // namespace

std::string StatementWords::next(const std::string& what) {
  if (at_end())
    throw StatementError("the line ends where " + what + " should be",
                         "Add " + what + " at the end of the line.");
  std::string word = words_.front();
  words_ = words_.subspan(1);
  return word;
}

bool StatementWords::accept(const std::string& word) {
  if (peek() != word)
    return false;
  words_ = words_.subspan(1);
  return true;
}

double StatementWords::number(const std::string& what, double low, double high) {
  const std::string word = next(what);
  return in_range(parse_number(word), word, what, low, high, "a number, for example 30");
}

double StatementWords::length(const std::string& what, double low, double high) {
  const std::string word = next(what);
  return in_range(parse_length(word), word, what, low, high,
                  "a length in metres, for example 0.06, or 6cm");
}

double StatementWords::seconds(const std::string& what, double high) {
  const std::string word = next(what);
  if (parse_number(word))
    throw StatementError("\"" + word + "\" has no unit",
                         "Write " + word + "s for seconds, or " + word + "ms for milliseconds.");
  return in_range(parse_seconds(word), word, what, 0, high, "a time, for example 2s or 500ms");
}

std::string StatementWords::name(const std::string& what) {
  const std::string word = next(what);
  if (!is_statement_name(word))
    throw StatementError("\"" + word + "\" is no name", "A name is one word of at most 64 letters, "
                                                        "digits, - and _.");
  return word;
}

void StatementWords::expect_end() const {
  if (!at_end())
    throw StatementError("\"" + peek() + "\" is one word too many in this line",
                         "Remove it, or begin a new line with it.");
}

bool is_statement_name(const std::string& word) {
  return !word.empty() && word.size() <= 64 && std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

std::string readable(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

std::string joined(std::span<const std::string> names) {
  std::string result;
  for (const auto& name : names)
    result += (result.empty() ? "" : ", ") + name;
  return result;
}

std::string remedy_for(const std::string& word, std::span<const std::string> names,
                       const std::string& what) {
  const auto guess = did_you_mean(word, {names.begin(), names.end()});
  return !guess.empty() ? guess : "The " + what + " are: " + joined(names) + ".";
}

} // namespace castor
