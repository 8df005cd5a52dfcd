#include "castor/actors/cast/arguments.hpp"

#include "castor/base/text.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace castor::cast {

namespace {

/// A quote that begins here and does not end in the same word. A lone quote is an opening one.
bool opens_quote(std::string_view word) noexcept {
  return word.starts_with('"') && (word.size() == 1 || !word.ends_with('"'));
}

std::string without_quotes(std::string word) {
  if (word.size() >= 2 && word.starts_with('"') && word.ends_with('"'))
    return word.substr(1, word.size() - 2);
  return word;
}

/// -5, -.5, or a dash alone: most likely meant as a value.
bool looks_like_value(std::string_view key) noexcept {
  auto rest = key.substr(1);
  return rest.empty() || is_digit(rest.front()) ||
         (rest.size() > 1 && rest.front() == '.' && is_digit(rest[1]));
}

class ArgumentParser {
public:
  ArgumentParser(WordStream& words, const StructureLine& line, DiagnosticLog& log)
    : words_(words), line_(line), log_(log) {
    // nop
  }

  std::vector<OptionSetting> run() {
    while (auto word = words_.next()) {
      if (word->starts_with('#'))
        break;
      if (word->starts_with('-'))
        begin_key(std::move(*word));
      else if (opens_quote(*word))
        quoted_value(std::move(*word));
      else
        value(without_quotes(std::move(*word)));
    }
    if (key_)
      set("true");
    return std::move(options_);
  }

private:
  void begin_key(std::string word) {
    if (looks_like_value(word))
      report(Severity::warning,
             in_quotes(word) + " is an option, not the value of " +
               (key_ ? in_quotes(*key_) : std::string("one")),
             "write \"" + shorten(word, 80) + "\" with the quotes to pass it as a value");
    if (key_)
      set("true");
    key_ = std::move(word);
  }

  void quoted_value(std::string text) {
    auto opening = text;
    while (auto word = words_.next()) {
      text += ' ';
      text += *word;
      if (word->ends_with('"')) {
        value(without_quotes(std::move(text)));
        return;
      }
    }
    report(Severity::error, "the quote that begins with " + in_quotes(opening) + " has no end",
           "write \" behind the last word of the value");
    key_.reset();
  }

  void value(std::string text) {
    if (key_) {
      set(std::move(text));
      return;
    }
    // Once per line: the words that follow are most likely part of the same value.
    if (std::exchange(has_stray_value_, true))
      return;
    auto remedy = options_.empty()
                    ? "write --name " + shorten(text, 80) + " with the name of the option"
                    : "write \"" + shorten(options_.back().value, 80) + " " + shorten(text, 80) +
                        "\" with the quotes to pass several words as one value";
    report(Severity::error, in_quotes(text) + " is a value without an option before it",
           std::move(remedy));
  }

  /// Gives the pending key its value.
  void set(std::string text) {
    auto [position, is_new] = index_.try_emplace(*key_, options_.size());
    if (is_new) {
      options_.push_back({std::move(*key_), std::move(text), line_.line->where()});
    } else {
      auto& option = options_[position->second];
      report(Severity::warning,
             in_quotes(option.key) + " is given twice: " + in_quotes(text) + " counts, " +
               in_quotes(option.value) + " does not",
             "remove one of them");
      option.value = std::move(text);
    }
    key_.reset();
  }

  void report(Severity severity, std::string message, std::string remedy) {
    log_.report(severity, *line_.line, std::move(message), std::move(remedy), line_.text);
  }

  WordStream& words_;
  const StructureLine& line_;
  DiagnosticLog& log_;
  std::vector<OptionSetting> options_;
  std::unordered_map<std::string, std::size_t> index_;
  std::optional<std::string> key_;
  bool has_stray_value_ = false;
};

} // namespace

std::vector<OptionSetting> parse_arguments(WordStream& words, const StructureLine& line,
                                           DiagnosticLog& log) {
  return ArgumentParser(words, line, log).run();
}

} // namespace castor::cast
