#include "castor/actors/cast/words.hpp"

#include "castor/base/text.hpp"

namespace castor::cast {

bool is_given(const std::optional<std::string>& word) noexcept {
  return word && !word->empty() && !word->starts_with('#');
}

WordStream::WordStream(const StructureLine& line, const Environment& environment,
                       DiagnosticLog& log)
  : line_(line), rest_(line.text), environment_(environment), log_(log) {
  // nop
}

std::optional<std::string> WordStream::next() {
  auto word = take_word(rest_);
  if (word.empty())
    return std::nullopt;
  if (word.front() != '$')
    return std::string(word);
  std::string name(word.substr(1));
  if (auto value = environment_(name))
    return value;
  log_.report(
    Severity::error, *line_.line, "environment variable " + in_quotes(word) + " is not set",
    name.empty() ? "write the name of a variable behind the $"
                 : "set " + shorten(name, 80) + " in the environment, or write the value itself",
    line_.text);
  return std::string(word);
}

void WordStream::warn_of_rest() const {
  if (auto rest = trim(rest_); !rest.empty() && rest.front() != '#')
    log_.report(Severity::warning, *line_.line, in_quotes(rest) + " is ignored",
                "remove it, or write # before a comment", line_.text);
}

std::string_view WordStream::peek() const noexcept {
  auto rest = rest_;
  return take_word(rest);
}

} // namespace castor::cast
